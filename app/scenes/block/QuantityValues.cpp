#include "app/scenes/block/QuantityValues.h"

namespace palp {

namespace {

std::vector<double> listOf(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

/// Below a thousandth of the largest pressure a quotient has no meaning.
std::vector<double> frictionUsed(const NodalFields& fields) {
  std::vector<double> shares(static_cast<std::size_t>(fields.displacement_mm.cols()), 0.0);
  const Eigen::Matrix3Xd& traction = fields.contactTraction_MPa;
  const double least = traction.cols() > 0 ? 1e-3 * -traction.row(2).minCoeff() : 0;
  for (Eigen::Index k = 0; k < traction.cols(); ++k)
    if (const double pressure = -traction(2, k); pressure > least)
      shares[static_cast<std::size_t>(k)] = traction.col(k).head<2>().norm() / pressure;
  return shares;
}

} // namespace

std::vector<double> quantityValues(Quantity quantity, const NodalFields& fields) {
  switch (quantity) {
  case Quantity::Displacement:
    return listOf(fields.displacement_mm.colwise().norm().transpose());
  case Quantity::DisplacementX:
    return listOf(fields.displacement_mm.row(0).transpose());
  case Quantity::DisplacementY:
    return listOf(fields.displacement_mm.row(1).transpose());
  case Quantity::DisplacementZ:
    return listOf(fields.displacement_mm.row(2).transpose());
  case Quantity::Pressure:
    return listOf(fields.pressure_MPa);
  case Quantity::VolumeChange:
    return listOf(fields.volumeRatio.array() - 1);
  case Quantity::VonMises:
    return listOf(fields.vonMises_MPa);
  case Quantity::StressXX:
  case Quantity::StressYY:
  case Quantity::StressZZ:
  case Quantity::StressXY:
  case Quantity::StressYZ:
  case Quantity::StressXZ:
    return listOf(fields.cauchy_MPa.row(static_cast<int>(quantity) - static_cast<int>(Quantity::StressXX)).transpose());
  case Quantity::LargestStretch:
  case Quantity::MiddleStretch:
  case Quantity::SmallestStretch:
    return listOf(fields.principalStretches.row(static_cast<int>(quantity) - static_cast<int>(Quantity::LargestStretch))
                      .transpose());
  case Quantity::ContactPressure:
  case Quantity::ContactShear:
    if (fields.contactTraction_MPa.cols() == 0)
      return std::vector<double>(static_cast<std::size_t>(fields.displacement_mm.cols()), 0.0);
    if (quantity == Quantity::ContactPressure) return listOf(-fields.contactTraction_MPa.row(2).transpose());
    return listOf(fields.contactTraction_MPa.topRows<2>().colwise().norm().transpose());
  case Quantity::FrictionUsed:
    return frictionUsed(fields);
  }
  return {};
}

std::vector<double> quantityValues(Quantity quantity, const NodalFields& fields, const NodalFields& less) {
  std::vector<double> values = quantityValues(quantity, fields);
  const std::vector<double> other = quantityValues(quantity, less);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] -= other[k];
  return values;
}

} // namespace palp
