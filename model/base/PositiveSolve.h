#pragma once

#include <Eigen/Cholesky>

#include <algorithm>
#include <optional>

namespace palp {

/// Cholesky factor of a symmetric matrix; nullopt where that is not positive definite or not finite, for which Eigen's
/// own factorisation returns finite garbage.
template <class Matrix>
std::optional<Eigen::LLT<typename Matrix::PlainObject>> positiveFactor(const Eigen::MatrixBase<Matrix>& matrix) {
  Eigen::LLT<typename Matrix::PlainObject> factor(matrix);
  if (factor.info() != Eigen::Success || !factor.matrixLLT().diagonal().allFinite()) return {};
  return factor;
}

/// The same without roots, L D L', which also takes what is singular to rounding; none where a number is not finite or
/// an entry of D is below 0 by more than rounding of the largest, or of `size`: what the matrix is a difference of.
template <class Matrix>
std::optional<Eigen::LDLT<typename Matrix::PlainObject>> semidefiniteFactor(const Eigen::MatrixBase<Matrix>& matrix,
                                                                            double size = 0) {
  constexpr double rounding = 1e-9;
  Eigen::LDLT<typename Matrix::PlainObject> factor(matrix);
  const auto d = factor.vectorD().array();
  if (!matrix.allFinite() || !d.allFinite()) return {}; // its info() also means what is singular
  if (d.size() > 0 && d.minCoeff() < -rounding * std::max(size, d.abs().maxCoeff())) return {};
  return factor;
}

/// x of matrix x = right. Throws `Refusal` with the words where the matrix is not positive definite.
template <class Refusal, class Matrix, class Right>
Eigen::MatrixXd solvePositive(const Eigen::MatrixBase<Matrix>& matrix, const Eigen::MatrixBase<Right>& right,
                              const char* words) {
  const auto factor = positiveFactor(matrix);
  if (!factor) throw Refusal(words);
  return factor->solve(right);
}

} // namespace palp
