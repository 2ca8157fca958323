#include "solver/ConductionField.h"

#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "solver/field/DeformedGreen.h"

#include <mutex>

namespace palp {

namespace {

const FieldLaw& fieldLaw(const SensorDesign& design) {
  if (!design.field()) throw DesignError("resistance: the conduction field; allowed is a design with law field");
  if (design.pressureLaw)
    throw DesignError("resistance.pressure_law: in the deformed block under the field law: not yet; allowed is null");
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

  [[nodiscard]] FieldState places(const Eigen::Matrix3Xd& displacements_mm, const ElectrodeDisplacements& moved) const {
    FieldState at{green.mesh().tets().nodes_mm + green.mesh().atNodes(displacements_mm), electrodes_mm};
    at.electrodes_mm.leftCols(moved.upper_mm.cols()) += moved.upper_mm;
    if (problem.design().lowerFollowsRubber) at.electrodes_mm.rightCols(moved.lower_mm.cols()) += moved.lower_mm;
    return at;
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

std::optional<TerminalNetwork> ConductionField::network(const LoadIncrement& state, int threads,
                                                        const std::stop_token& stop) const {
  return network(state.displacements_mm, state_->problem.electrodes(state), threads, stop);
}

std::optional<TerminalNetwork> ConductionField::network(const Eigen::Matrix3Xd& displacements_mm,
                                                        const ElectrodeDisplacements& electrodes, int threads,
                                                        const std::stop_token& stop) const {
  const auto correction = state_->correction_ohm(threads, stop);
  if (!correction) return {};
  const auto green = state_->green.at(state_->places(displacements_mm, electrodes), threads, stop);
  if (!green) return {};
  return TerminalNetwork(potentials_ohm(*green, state_->law) + *correction, wireCounts(state_->problem.design()),
                         state_->law.wire_ohm);
}

std::optional<CurrentField> ConductionField::current(const LoadIncrement& state, int rowWire, int columnWire,
                                                     int threads, const std::stop_token& stop) const {
  const auto network = this->network(state, threads, stop);
  if (!network) return {};
  const FieldLaw& law = state_->law;
  Eigen::VectorXd terminals = NetworkReading(*network, law.readout).potentials(rowWire, columnWire);
  const Eigen::Index column = network->counts().rowWires + columnWire;
  terminals = ((terminals.array() - terminals(column)) / (terminals(rowWire) - terminals(column))).matrix().eval();
  const Eigen::VectorXd wires = network->inBlock() * terminals;
  const Eigen::VectorXd currents = network->currents() * wires;
  const auto found = state_->green.potential(state_->places(state.displacements_mm, state_->problem.electrodes(state)),
                                             currents, law.electrodeRadius_mm, threads, stop);
  if (!found) return {};
  // The constant that the field leaves open: that which the electrodes' potentials have in the mean.
  const double rho = law.resistivity_ohm_mm, contact = contactResistance_ohm(law);
  const Eigen::VectorXd electrodes = network->counts().atElectrodes(wires);
  const double shift = (electrodes - rho * found->electrodes - contact * currents).mean();
  const Eigen::Index nodes = state_->problem.mesh().nodeCount();
  CurrentField field{(rho * found->value.head(nodes)).array() + shift, -found->gradient.leftCols(nodes), {}};
  field.powerDensity_W_per_mm3 = rho * field.currentDensity_A_per_mm2.colwise().squaredNorm().transpose();
  return field;
}

} // namespace palp
