#include "app/study/decoding/NoiseBound.h"

#include "app/study/decoding/Prediction.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/InverseDiagonal.h"
#include "model/base/NumberText.h"
#include "model/base/Text.h"
#include "nn/baselines/ForwardModel.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>

namespace palp {
namespace {

/// What is known of a force before any reading, in units of its range: a uniform density has the variance range^2 / 12,
/// and a normal one of that variance carries 12 / range^2 of information. For the uniform one the sum with Fisher's is
/// that of the best linear estimate, no lower bound: van Trees' inequality asks for a density that is smooth at its
/// ends.
constexpr double kPriorInformation = 12;

std::string components(const Eigen::VectorXd& percent) {
  std::string words;
  for (const double value : percent) {
    const bool finite = std::isfinite(value);
    words += (words.empty() ? "" : " ") + (finite ? withDigits(value, 6) : std::isnan(value) ? "-" : "unlimited");
  }
  return words;
}

} // namespace

NoiseBound noiseBound(const SampleSet& samples, InputKind kind, const std::vector<int>& rows, double relativeNoise) {
  if (!(relativeNoise > 0 && relativeNoise < 1))
    throw Error("noise: " + gotExpected(relativeNoise, "", "above 0 and below 1 (relative) for a bound"));
  DecoderInput input;
  input.kind = kind;
  input.rows = rows;
  input.rowWires = samples.rowWires;
  input.valuesPerRow = kind == InputKind::Displacement ? 3 * samples.electrodesPerRowWire : samples.columnWires;
  const Eigen::MatrixXd x = inputsOf(samples, input);
  const int classes = samples.together() ? 1 : samples.area.maxCoeff() + 1;
  const Eigen::VectorXd range = samples.forces_N.rowwise().maxCoeff() - samples.forces_N.rowwise().minCoeff();
  // A component that never varied has no range that an error could be a share of, and no reading is expected to tell
  // it.
  std::vector<Eigen::Index> varied;
  for (Eigen::Index k = 0; k < range.size(); ++k)
    if (range(k) > 0) varied.push_back(k);
  const auto outputs = static_cast<Eigen::Index>(varied.size());
  const NoiseBound unknown{Eigen::VectorXd::Constant(range.size(), NAN), Eigen::VectorXd::Constant(range.size(), NAN)};
  if (varied.empty()) return unknown;
  Eigen::ArrayXd without = Eigen::ArrayXd::Zero(outputs), with = without;
  for (int c = 0; c < classes; ++c) {
    std::vector<Eigen::Index> members;
    for (Eigen::Index i = 0; i < samples.size(); ++i)
      if (samples.together() || samples.area(i) == c) members.push_back(i);
    if (members.empty()) continue;
    const ForwardModel model = fitForwardModel(x(Eigen::all, members), samples.forces_N(Eigen::all, members),
                                               Eigen::VectorXi::Zero(static_cast<Eigen::Index>(members.size())), {});
    if (model.degree == 0) // no slopes: too few samples to say anything, neither that the bound is the prior alone
      return unknown;
    for (const Eigen::Index i : members) {
      Eigen::MatrixXd slope;
      const Eigen::VectorXd value = model.measurementsOf(0, samples.forces_N.col(i), &slope);
      // Fisher information of a reading x with normal noise sigma x: I = J^T J / sigma^2, J = (dx/dF) / x; no unbiased
      // estimate of F has a variance below diag(I^-1) (Cramer and Rao; Kay, Estimation Theory, section 3.7). In units
      // of the force range, so that large and small forces are of one size in the matrix.
      const Eigen::MatrixXd j =
          value.cwiseInverse().asDiagonal() * slope(Eigen::all, varied) * range(varied).asDiagonal();
      const Eigen::MatrixXd information = j.transpose() * j / (relativeNoise * relativeNoise);
      without += inverseDiagonal(information).array();
      const Eigen::MatrixXd prior = kPriorInformation * Eigen::MatrixXd::Identity(outputs, outputs);
      with += inverseDiagonal(Eigen::MatrixXd(information + prior)).array();
    }
  }
  const double count = static_cast<double>(samples.size());
  NoiseBound bound = unknown;
  bound.withoutPriorPercent(varied) = 100 * (without / count).sqrt();
  bound.withPriorPercent(varied) = 100 * (with / count).sqrt();
  return bound;
}

std::string inWords(const NoiseBound& bound) {
  const Eigen::VectorXd &without = bound.withoutPriorPercent, &with = bound.withPriorPercent;
  if (with.array().isNaN().all())
    return "not known: an area has too few samples to learn how its readings follow the force, or no force varies";
  std::string words = "without prior " + components(without) + "; with prior " + components(with);
  if (without.array().isInf().any()) words += "; unlimited: the readings do not determine this force";
  if (with.array().isNaN().any()) words += "; -: does not vary in the samples";
  return words;
}

} // namespace palp
