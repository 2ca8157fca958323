#include "solver/ConductionField.h"

#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "model/base/GotExpected.h"
#include "solver/assembly/NodalFields.h"
#include "solver/field/DeformedGreen.h"

#include <Eigen/Dense>

#include <mutex>
#include <string>

namespace palp {

namespace {

const FieldLaw& fieldLaw(const SensorDesign& design) {
  if (!design.field()) throw DesignError("resistance.law: " + gotExpected("pairs", "field, for the conduction field"));
  return *design.field();
}

} // namespace

struct ConductionField::State {
  HyperelasticProblem problem;
  FieldLaw law;
  Eigen::Matrix3Xd electrodes_mm;
  DeformedGreen green;

  explicit State(HyperelasticProblem p)
      : problem(std::move(p)), law(fieldLaw(problem.design())), electrodes_mm(palp::electrodes_mm(problem.design())),
        green(problem.mesh(), problem.design().block_mm, electrodes_mm) {}

  [[nodiscard]] FieldState places(const LoadIncrement& state, const ElectrodeDisplacements& moved) const {
    FieldState at{green.mesh().tets().nodes_mm + green.mesh().atNodes(state.displacements_mm),
                  electrodes_mm,
                  {},
                  law.electrodeRadius_mm};
    at.electrodes_mm.leftCols(moved.upper_mm.cols()) += moved.upper_mm;
    if (problem.design().lowerFollowsRubber) at.electrodes_mm.rightCols(moved.lower_mm.cols()) += moved.lower_mm;
    if (const auto& byPressure = problem.design().pressureLaw) {
      const Eigen::VectorXd pressures = nodalPressures_MPa(problem.mesh(), state);
      if ((pressures.array() > 0).any())
        at.conductivity = {green.mesh().atNodes(pressures.transpose()).transpose(), *byPressure};
    }
    return at;
  }

  /// P of a state. Empty: stopped.
  [[nodiscard]] std::optional<Eigen::MatrixXd> potentials(const FieldState& state, int threads,
                                                          const std::stop_token& stop) const {
    const auto correction = correction_ohm(threads, stop);
    if (!correction) return {};
    const auto found = green.at(state, threads, stop);
    if (!found) return {};
    if (!state.conductivity.heterogeneous()) return potentials_ohm(*found, law) + *correction;
    const Eigen::VectorXd conductivities = green.conductivities(state);
    const Eigen::VectorXd inverse = conductivities.cwiseSqrt().cwiseInverse();
    // Without terms of p alone and of q alone, which would become visible.
    Eigen::MatrixXd seen = correction->rowwise() - correction->colwise().mean();
    seen.colwise() -= seen.rowwise().mean().eval();
    return potentials_ohm(*found, law, SphereModel::Dipoles, conductivities) +
           inverse.asDiagonal() * seen * inverse.asDiagonal();
  }

  /// P of the box less that of the mesh at rest. Empty: stopped.
  std::shared_ptr<const Eigen::MatrixXd> correction_ohm(int threads, const std::stop_token& stop) const {
    const std::lock_guard lock(guard_);
    if (correction_) return correction_;
    const auto rest = green.at({green.mesh().tets().nodes_mm, electrodes_mm}, threads, stop);
    if (!rest) return {};
    correction_ = std::make_shared<const Eigen::MatrixXd>(
        potentialsAtRest_ohm(problem.design().block_mm, electrodes_mm, law) - potentials_ohm(*rest, law));
    return correction_;
  }

private:
  mutable std::mutex guard_;
  mutable std::shared_ptr<const Eigen::MatrixXd> correction_;
};

ConductionField::ConductionField(HyperelasticProblem problem) : state_(std::make_unique<State>(std::move(problem))) {}
ConductionField::~ConductionField() = default;

void ConductionField::requirePositive(const TerminalNetwork& network, Readout readout) {
  const Eigen::MatrixXd resistances_ohm = NetworkReading(network, readout).resistances_ohm();
  const Eigen::Index wrong = (!(resistances_ohm.array() > 0)).count();
  if (wrong > 0)
    throw DesignError("resistance.pressure_law: " + std::to_string(wrong) + " of " +
                      std::to_string(resistances_ohm.size()) + " resistances (" + kReadouts.name(readout) +
                      ") are not positive; the pressure law is too steep for this load, or the mesh too coarse");
}

std::optional<TerminalNetwork> ConductionField::network(const LoadIncrement& state, int threads,
                                                        const std::stop_token& stop) const {
  return network(state, state_->problem.electrodes(state), threads, stop);
}

std::optional<TerminalNetwork> ConductionField::network(const LoadIncrement& state,
                                                        const ElectrodeDisplacements& electrodes, int threads,
                                                        const std::stop_token& stop) const {
  if (stop.stop_requested()) return {}; // of many states those that have not begun
  const auto potentials = state_->potentials(state_->places(state, electrodes), threads, stop);
  if (!potentials) return {};
  TerminalNetwork network(*potentials, wireCounts(state_->problem.design()), state_->law.wire_ohm);
  if (state_->problem.design().pressureLaw) requirePositive(network, state_->law.readout);
  return network;
}

std::optional<CurrentField> ConductionField::current(const LoadIncrement& state, const TerminalNetwork& network,
                                                     Readout readout, int rowWire, int columnWire, int threads,
                                                     const std::stop_token& stop) const {
  const FieldLaw& law = state_->law;
  Eigen::VectorXd terminals = NetworkReading(network, readout).potentials(rowWire, columnWire);
  const Eigen::Index column = network.counts().rowWires + columnWire;
  terminals = ((terminals.array() - terminals(column)) / (terminals(rowWire) - terminals(column))).matrix().eval();
  const Eigen::VectorXd wires = network.inBlock() * terminals;
  const Eigen::VectorXd currents = network.currents() * wires;
  const FieldState places = state_->places(state, state_->problem.electrodes(state));
  const auto found = state_->green.potential(places, currents, threads, stop);
  if (!found) return {};
  // The constant that the field leaves open: that which the electrodes' potentials have in the mean.
  const double rho = law.resistivity_ohm_mm, contact = contactResistance_ohm(law);
  const Eigen::VectorXd electrodes = network.counts().atElectrodes(wires);
  const double shift = (electrodes - rho * found->electrodes - contact * currents).mean();
  const Eigen::Index nodes = state_->problem.mesh().nodeCount();
  CurrentField field{(rho * found->value.head(nodes)).array() + shift, -found->gradient.leftCols(nodes), {}, currents};
  Eigen::ArrayXd logarithms = Eigen::ArrayXd::Zero(nodes); // ln k
  if (const FieldConductivity& k = places.conductivity; k.heterogeneous())
    logarithms = k.pressures_MPa.head(nodes).unaryExpr([&](double p) { return 2 * k.halfLogConductivity(p); });
  field.currentDensity_A_per_mm2 *= logarithms.exp().matrix().asDiagonal();
  field.powerDensity_W_per_mm3 = rho * field.currentDensity_A_per_mm2.colwise().squaredNorm().transpose();
  field.powerDensity_W_per_mm3.array() *= (-logarithms).exp();
  return field;
}

} // namespace palp
