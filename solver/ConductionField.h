#pragma once

#include "model/TerminalNetwork.h"
#include "solver/HyperelasticProblem.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <stop_token>

namespace palp {

/// Current density and potential while one row-wire and one column-wire are read, at the nodes of the solver's mesh,
/// for 1 V between the two; inside an electrode's sphere its potential and no current.
struct CurrentField {
  Eigen::VectorXd potential_V;               ///< measured from the column-wire
  Eigen::Matrix3Xd currentDensity_A_per_mm2; ///< 3 x nodes
  Eigen::VectorXd powerDensity_W_per_mm3;
  Eigen::VectorXd electrodes_A; ///< from each electrode into the rubber
};

/// Resistances of the deformed block under the law of the field: quadratic tetrahedra on the displaced nodes of the
/// solver's mesh, with the fields of the electrodes and of their mirror images subtracted in closed form. Lower
/// electrodes follow the rubber or are fixed, as the design prescribes. The mesh's result at rest is replaced by the
/// closed form (model/FieldAtRest.h), so that its errors cancel: P = P_box + P_mesh(state) - P_mesh(rest). Under a
/// pressure law the pressure is computed at the nodes (nodalPressures_MPa) and is quadratic between; P_box -
/// P_mesh(rest), without the terms that have no effect for currents of zero sum, is divided by m_p m_q. Threads may
/// share it.
class ConductionField {
public:
  /// Throws DesignError unless all resistances are above 0: a pressure law may vary the conductivity more than the mesh
  /// bears, and currents that other wires screen then have the wrong sign.
  static void requirePositive(const TerminalNetwork& network, Readout readout);

  /// Throws DesignError where the design has another law.
  explicit ConductionField(HyperelasticProblem problem);
  ~ConductionField();

  /// None: stopped. Throws DesignError where the load turns elements inside out, or as requirePositive for the
  /// design's read-out under a pressure law. The same bytes at any number of threads (0: all cores).
  [[nodiscard]] std::optional<TerminalNetwork> network(const LoadIncrement& state, int threads = 0,
                                                       const std::stop_token& stop = {}) const;
  /// The same where the electrodes' displacements are known; the elements' unknowns matter under a pressure law alone.
  [[nodiscard]] std::optional<TerminalNetwork> network(const LoadIncrement& state,
                                                       const ElectrodeDisplacements& electrodes, int threads = 0,
                                                       const std::stop_token& stop = {}) const;
  /// Current density and potential in a state with this network, for any read-out. Returns nullopt if cancelled.
  [[nodiscard]] std::optional<CurrentField> current(const LoadIncrement& state, const TerminalNetwork& network,
                                                    Readout readout, int rowWire, int columnWire, int threads = 0,
                                                    const std::stop_token& stop = {}) const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace palp
