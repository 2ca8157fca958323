#pragma once

#include <Eigen/Core>

#include <array>

namespace palp {

/// Smooth functions of a few inputs, up to two of which are coordinates of a position, tabulated for fast evaluation:
/// over the positions uniform cubic B-splines (C. de Boor, A Practical Guide to Splines, 2001, chapter IX), in the
/// other inputs monomials whose coefficients the splines are.
struct SplineTable {
  static constexpr double kParts =
      20; ///< coefficients are rounded to one such part of a deviation of the noise, their unit

  std::array<int, 2> place{-1, -1}; ///< which inputs are coordinates of the position; -1: none
  Eigen::Array2d low{0, 0}, step{1, 1};
  std::array<int, 2> nodes{4, 4}; ///< splines along each coordinate, 4 or more; without a coordinate all are equal
  Eigen::VectorXd shift;          ///< of each input: monomials are of input + shift
  Eigen::MatrixXi exponents;      ///< inputs x terms; 0 for the position
  Eigen::VectorXd rest;           ///< outputs: the part that does not depend on the inputs
  Eigen::MatrixXd coefficients;   ///< outputs x (terms x nodes x nodes), the term first, then the first coordinate

  [[nodiscard]] Eigen::Index inputs() const { return shift.size(); }
  [[nodiscard]] Eigen::Index outputs() const { return rest.size(); }
  [[nodiscard]] Eigen::Index terms() const { return exponents.cols(); }

  /// Outputs and their derivatives (outputs x inputs) at one input vector. Constant beyond the table's edge.
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& input, Eigen::VectorXd& value, Eigen::MatrixXd& slope) const;

  /// Coefficients of the splines through values at the nodes but the first and the last along each coordinate
  /// (outputs x (terms x nodes x nodes) as `coefficients`, the outermost not read); exact for cubics where there are
  /// six nodes or more.
  void interpolate(Eigen::MatrixXd values);

  /// Rounds the coefficients to multiples of 1 / kParts.
  void round() { coefficients = (kParts * coefficients).array().round() / kParts; }

private:
  friend class SplineReader;
  template <class Number>
  void evaluate(const Number* numbers, double unit, const Eigen::Ref<const Eigen::VectorXd>& input,
                Eigen::VectorXd& value, Eigen::MatrixXd& slope) const;
  [[nodiscard]] Eigen::MatrixXd monomials(const Eigen::Ref<const Eigen::VectorXd>& input) const;
};

/// Evaluates the same table many times: its coefficients as numbers of parts in single precision, which is exact for
/// integers below 2^24 and halves the memory traffic. The table must outlive it.
class SplineReader {
public:
  explicit SplineReader(const SplineTable& table);
  /// As SplineTable::evaluate.
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& input, Eigen::VectorXd& value, Eigen::MatrixXd& slope) const;

private:
  const SplineTable& table_;
  Eigen::MatrixXf parts_; ///< as SplineTable::coefficients
};

} // namespace palp
