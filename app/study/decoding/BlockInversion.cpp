#include "app/study/decoding/BlockInversion.h"

#include "app/study/reports/layout/AreaResponse.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/layout/SignalComparison.h"
#include "model/DesignError.h"
#include "model/base/Cancelled.h"
#include "model/base/PositiveSolve.h"

#include <Eigen/SVD>

#include <algorithm>

namespace palp {

namespace {

constexpr double kLeastNoise = 1e-6;
constexpr double kUniformVariance = 1.0 / 12; // of what is uniform over a range of 1
constexpr double kSeen = 1e-12;               // share of the largest singular value that counts

} // namespace

BlockInversion blockInversion(const SensorDesign& design, const std::vector<int>& rows, double relativeNoise,
                              int threads, const std::stop_token& stop, FitReport& report) {
  requireSmoothAtRest(design);
  StageLog stages;
  const auto response = AreaResponse::atRest(design, {}, threads, stages, {}, stop);
  if (!response) throw Cancelled();
  const FieldLaw& law = *design.field();
  const FieldResponse field(design, law, *response, threads, 1, stop);
  const Eigen::MatrixXd rest_ohm = field.resistances_ohm(law.readout);
  const LogSensitivity slopes = field.logSensitivity(law.readout);
  const std::vector<ElectrodeResponse> electrodes = response->read(design, -1);
  const Eigen::Vector3d range_N = design.forceRange.high_N - design.forceRange.low_N;
  const Eigen::Index columns = design.columnWires(), perRow = design.electrodesPerRowWire(),
                     count = static_cast<Eigen::Index>(rows.size()),
                     forces = 3 * static_cast<Eigen::Index>(slopes.size());
  BlockInversion block{Eigen::VectorXd(count * columns), {}, Eigen::MatrixXd(3 * perRow * count, forces)};
  Eigen::MatrixXd j(count * columns, forces); // d ln R / d(F / range)
  Eigen::VectorXd ranges_N(forces);
  for (Eigen::Index f = 0; f < forces; ++f) {
    const auto area = static_cast<std::size_t>(f / 3), axis = static_cast<std::size_t>(f % 3);
    ranges_N(f) = range_N(f % 3);
    const Eigen::Matrix3Xd& moved = electrodes[area].perNewton[axis].upper_mm;
    for (Eigen::Index r = 0; r < count; ++r) {
      const Eigen::Index row = rows[static_cast<std::size_t>(r)];
      block.rest_ohm.segment(r * columns, columns) = rest_ohm.row(row).transpose();
      j.col(f).segment(r * columns, columns) = ranges_N(f) * slopes[area][axis].row(row).transpose();
      block.modes_mm_per_N.col(f).segment(3 * perRow * r, 3 * perRow) =
          moved.middleCols(row * perRow, perRow).reshaped();
    }
  }
  const Eigen::VectorXd singular = Eigen::JacobiSVD<Eigen::MatrixXd>(j).singularValues();
  report.rank = static_cast<int>((singular.array() > kSeen * singular(0)).count());
  report.condition = singular(0) / singular(singular.size() - 1);
  const double noise = std::max(relativeNoise, kLeastNoise);
  Eigen::MatrixXd information = j.transpose() * j;
  information.diagonal().array() += noise * noise / kUniformVariance;
  const auto factor = semidefiniteFactor(information);
  if (!factor) throw DesignError("the readings of this design do not follow its forces in finite numbers");
  block.forces_N = ranges_N.asDiagonal() * factor->solve(j.transpose());
  return block;
}

} // namespace palp
