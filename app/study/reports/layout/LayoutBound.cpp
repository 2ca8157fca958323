#include "app/study/reports/layout/LayoutBound.h"

#include "app/study/reports/layout/FieldResponse.h"
#include "model/base/InverseDiagonal.h"

#include <Eigen/Dense>

#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kUniformPrecision = 12; // of what is uniform over a range of 1

/// d ln R / d F of one row-wire, column-wires x 3 [1/N].
Eigen::MatrixX3d logSensitivity(const SensorDesign& layout, const ElectrodeResponse& response, int rowWire) {
  RowResistanceJacobian jacobian;
  const Eigen::VectorXd resistances = rowResistances(layout, response.middle, rowWire, &jacobian);
  const Eigen::Index perRow = layout.electrodesPerRowWire();
  const Eigen::Index perColumn = layout.electrodesPerColumnWire();
  Eigen::MatrixX3d result(layout.columnWires(), 3);
  for (int axis = 0; axis < 3; ++axis) {
    const ElectrodeDisplacements& slope = response.perNewton[static_cast<std::size_t>(axis)];
    const Eigen::Matrix3Xd upper = slope.upper_mm.middleCols(rowWire * perRow, perRow);
    Eigen::VectorXd change = jacobian.upper * upper.reshaped();
    change += jacobian.pressure * slope.upperPressure_MPa.segment(rowWire * perRow, perRow);
    for (Eigen::Index k = 0; k < change.size(); ++k) {
      const Eigen::Matrix3Xd lower = slope.lower_mm.middleCols(k * perColumn, perColumn);
      change(k) += jacobian.lower.row(k).dot(lower.reshaped());
    }
    result.col(axis) = change.cwiseQuotient(resistances);
  }
  return result;
}

Eigen::Vector3d rowsRootMeanSquare(const Eigen::Matrix3Xd& values) {
  return values.cwiseAbs2().rowwise().mean().cwiseSqrt();
}

} // namespace

Eigen::Vector3d LayoutBound::withoutPrior() const {
  return rowsRootMeanSquare(withoutPrior_percent);
}

Eigen::Vector3d LayoutBound::withPrior() const {
  return rowsRootMeanSquare(withPrior_percent);
}

double LayoutBound::mean() const {
  return std::cbrt(withoutPrior().prod());
}

std::vector<std::array<Eigen::MatrixXd, 3>> logSensitivity(const SensorDesign& layout, const AreaResponse& response) {
  std::vector<std::array<Eigen::MatrixXd, 3>> result;
  for (const ElectrodeResponse& area : response.read(layout, -1)) {
    std::array<Eigen::MatrixXd, 3>& slopes = result.emplace_back();
    slopes.fill(Eigen::MatrixXd(layout.rowWires(), layout.columnWires()));
    for (int row = 0; row < layout.rowWires(); ++row) {
      const Eigen::MatrixX3d ofRow = logSensitivity(layout, area, row);
      for (std::size_t axis = 0; axis < 3; ++axis)
        slopes[axis].row(row) = ofRow.col(static_cast<Eigen::Index>(axis)).transpose();
    }
  }
  return result;
}

LayoutBound boundOf(const std::vector<Eigen::Matrix3d>& information) {
  const auto count = static_cast<Eigen::Index>(information.size());
  LayoutBound bound{Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count)};
  for (Eigen::Index area = 0; area < count; ++area) {
    const Eigen::Matrix3d& measured = information[static_cast<std::size_t>(area)];
    bound.withoutPrior_percent.col(area) = 100 * inverseDiagonal(measured).cwiseSqrt();
    const Eigen::Matrix3d withPrior = measured + kUniformPrecision * Eigen::Matrix3d::Identity();
    bound.withPrior_percent.col(area) = 100 * inverseDiagonal(withPrior).cwiseSqrt();
  }
  return bound;
}

LayoutBound layoutBound(const SensorDesign& layout, const AreaResponse& response, int rowWire, double relativeNoise,
                        int threads, double fineness, const std::stop_token& stop) {
  if (const FieldLaw* law = layout.field())
    return FieldResponse(layout, *law, response, threads, fineness, stop).bound(law->readout, rowWire, relativeNoise);
  const std::vector<ElectrodeResponse> areas = response.read(layout, rowWire);
  // In units of the force range, so that large and small forces do not meet in one matrix.
  const Eigen::Vector3d range_N = layout.forceRange.high_N - layout.forceRange.low_N;
  const auto count = static_cast<Eigen::Index>(areas.size());
  std::vector<Eigen::Matrix3d> ofAreas;
  for (Eigen::Index area = 0; area < count; ++area) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    for (int row = rowWire < 0 ? 0 : rowWire; row <= (rowWire < 0 ? layout.rowWires() - 1 : rowWire); ++row) {
      const Eigen::MatrixX3d slope =
          logSensitivity(layout, areas[static_cast<std::size_t>(area)], row) * range_N.asDiagonal();
      information += slope.transpose() * slope / (relativeNoise * relativeNoise);
    }
    ofAreas.push_back(information);
  }
  return boundOf(ofAreas);
}

Eigen::VectorXd resistanceSingularValues(const SensorDesign& layout, int rowWire) {
  RowResistanceJacobian jacobian;
  const Eigen::VectorXd resistances =
      rowResistances(layout, ElectrodeDisplacements::atRest(layout), rowWire, &jacobian);
  const Eigen::MatrixXd logarithmic = resistances.cwiseInverse().asDiagonal() * jacobian.upper;
  return Eigen::JacobiSVD<Eigen::MatrixXd>(logarithmic).singularValues();
}

double condition(const Eigen::VectorXd& singularValues) {
  const double smallest = singularValues(singularValues.size() - 1);
  return smallest > 0 ? singularValues(0) / smallest : kInfinity;
}

} // namespace palp
