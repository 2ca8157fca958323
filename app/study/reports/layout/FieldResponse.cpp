#include "app/study/reports/layout/FieldResponse.h"

#include "model/DesignError.h"
#include "model/FieldSensitivity.h"
#include "model/base/GotExpected.h"

namespace palp {

void requireSmoothAtRest(const SensorDesign& design) {
  if (design.pressureLaw)
    throw DesignError("resistance.pressure_law: " +
                      gotExpected("a law with a kink at rest, where bounds under the field law are computed", "null"));
}

FieldResponse::FieldResponse(const SensorDesign& layout, const FieldLaw& law, const AreaResponse& response, int threads,
                             double fineness, const std::stop_token& stop)
    : FieldResponse(layout, FieldSensitivity(layout, law, SphereModel::Dipoles, fineness, threads), response, threads,
                    stop) {}

FieldResponse::FieldResponse(const SensorDesign& layout, const FieldSensitivity& field, const AreaResponse& response,
                             int threads, const std::stop_token& stop)
    : network_(field.network()), range_N_(layout.forceRange.high_N - layout.forceRange.low_N) {
  requireSmoothAtRest(layout);
  const auto faces = response.perNewtonAt(field.facePoints_mm(), threads);
  const std::vector<ElectrodeResponse> electrodes = response.read(layout, -1);
  std::vector<SensorMotion> motions;
  for (std::size_t area = 0; area < faces.size(); ++area)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const ElectrodeDisplacements& moved = electrodes[area].perNewton[axis];
      SensorMotion motion;
      motion.electrodes_mm.resize(3, moved.upper_mm.cols() + moved.lower_mm.cols());
      motion.electrodes_mm << moved.upper_mm, moved.lower_mm; // these are read as 0 where they are held
      motion.faces_mm = field.faceNormals().cwiseProduct(faces[area][axis]).colwise().sum();
      motions.push_back(std::move(motion));
    }
  std::vector<Eigen::MatrixXd> changes = field.conductanceChanges(motions, threads, stop);
  for (std::size_t area = 0; area < faces.size(); ++area)
    conductanceChanges_.push_back(
        {std::move(changes[3 * area]), std::move(changes[3 * area + 1]), std::move(changes[3 * area + 2])});
}

Eigen::MatrixXd FieldResponse::resistances_ohm(Readout readout) const {
  return NetworkReading(network_, readout).resistances_ohm();
}

std::vector<std::array<Eigen::MatrixXd, 3>> FieldResponse::logSensitivity(Readout readout) const {
  const NetworkReading reading(network_, readout);
  std::vector<std::array<Eigen::MatrixXd, 3>> result;
  for (const auto& changes : conductanceChanges_) {
    std::array<Eigen::MatrixXd, 3>& slopes = result.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis) slopes[axis] = reading.logChange(changes[axis]);
  }
  return result;
}

LayoutBound FieldResponse::bound(Readout readout, int rowWire, double relativeNoise) const {
  return bound(readout, rowWire,
               Eigen::MatrixXd::Constant(network_.counts().rowWires, network_.counts().columnWires, relativeNoise));
}

LayoutBound FieldResponse::bound(Readout readout, int rowWire,
                                 const Eigen::Ref<const Eigen::MatrixXd>& relativeNoise) const {
  std::vector<Eigen::Matrix3d> information;
  for (const auto& slopes : logSensitivity(readout)) {
    Eigen::MatrixX3d j(rowWire < 0 ? relativeNoise.size() : relativeNoise.cols(), 3);
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const Eigen::MatrixXd all = range_N_(axis) * slopes[static_cast<std::size_t>(axis)].cwiseQuotient(relativeNoise);
      if (rowWire < 0)
        j.col(axis) = all.reshaped();
      else
        j.col(axis) = all.row(rowWire).transpose();
    }
    information.emplace_back(j.transpose() * j);
  }
  return boundOf(information);
}

} // namespace palp
