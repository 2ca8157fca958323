#pragma once

#include <Eigen/Core>

#include <array>

namespace palp {

/// Smooth functions of a few inputs, of which up to two are places, written down so that they are quick to find: over
/// the places uniform cubic B-splines (C. de Boor, A Practical Guide to Splines, 2001, chapter IX), in the other inputs
/// monomials whose coefficients the splines are.
struct SplineTable {
  static constexpr double kParts = 20; ///< of a deviation of the noise, in which the outputs are: coefficients as kept

  std::array<int, 2> place{-1, -1}; ///< which inputs are places; -1: there is none
  Eigen::Array2d low{0, 0}, step{1, 1};
  std::array<int, 2> nodes{4, 4}; ///< splines along each place, 4 or more; where there is no place all are the same
  Eigen::VectorXd shift;          ///< of each input: monomials are of input + shift
  Eigen::MatrixXi exponents;      ///< inputs x terms; 0 for places
  Eigen::VectorXd rest;           ///< outputs: what does not depend on the inputs
  Eigen::MatrixXd coefficients;   ///< outputs x (terms x nodes x nodes), the term first, then the first place

  [[nodiscard]] Eigen::Index inputs() const { return shift.size(); }
  [[nodiscard]] Eigen::Index outputs() const { return rest.size(); }
  [[nodiscard]] Eigen::Index terms() const { return exponents.cols(); }

  /// Outputs and their derivatives (outputs x inputs) at one input vector. Beyond the table as at its edge.
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& input, Eigen::VectorXd& value, Eigen::MatrixXd& slope) const;

  /// Coefficients of the splines that go through values at the nodes but the first and the last along each place
  /// (outputs x (terms x nodes x nodes) as `coefficients`, the outermost not read); exact for cubics where there are
  /// six nodes or more.
  void interpolate(Eigen::MatrixXd values);

  /// Coefficients to whole parts.
  void round() { coefficients = (kParts * coefficients).array().round() / kParts; }

private:
  friend class SplineReader;
  template <class Number>
  void evaluate(const Number* numbers, double unit, const Eigen::Ref<const Eigen::VectorXd>& input,
                Eigen::VectorXd& value, Eigen::MatrixXd& slope) const;
  [[nodiscard]] Eigen::MatrixXd monomials(const Eigen::Ref<const Eigen::VectorXd>& input) const;
};

/// The same table to be asked many times: its coefficients as numbers of parts in single precision, which whole parts
/// below 2^24 are exactly, so that half as much is read. The table must outlive it.
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
