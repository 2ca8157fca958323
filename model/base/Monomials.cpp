#include "model/base/Monomials.h"

#include <cassert>
#include <vector>

namespace palp {

namespace {

/// Appends the monomials of this degree in the variables from k on, those before having the powers in `term`.
void append(Eigen::VectorXi& term, Eigen::Index k, int degree, std::vector<Eigen::VectorXi>& all) {
  if (k == term.size()) {
    if (degree == 0) all.push_back(term);
    return;
  }
  for (int power = degree; power >= (k + 1 == term.size() ? degree : 0); --power) {
    term(k) = power;
    append(term, k + 1, degree - power, all);
  }
}

} // namespace

Eigen::MatrixXi monomialExponents(Eigen::Index variables, int lowest, int highest) {
  assert(variables >= 0 && lowest >= 0 && "degrees and variables are counted from 0");
  std::vector<Eigen::VectorXi> all;
  Eigen::VectorXi term(variables);
  for (int degree = lowest; degree <= highest; ++degree) append(term, 0, degree, all);
  Eigen::MatrixXi exponents(variables, static_cast<Eigen::Index>(all.size()));
  for (std::size_t t = 0; t < all.size(); ++t) exponents.col(static_cast<Eigen::Index>(t)) = all[t];
  return exponents;
}

} // namespace palp
