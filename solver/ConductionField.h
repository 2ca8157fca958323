#pragma once

#include "model/TerminalNetwork.h"
#include "solver/HyperelasticProblem.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <stop_token>

namespace palp {

/// The current's way while one row-wire and one column-wire are read, at the nodes of the solver's mesh, for 1 V
/// between the two; inside an electrode's sphere its potential and no current.
struct CurrentField {
  Eigen::VectorXd potential_V;               ///< measured from the column-wire
  Eigen::Matrix3Xd currentDensity_A_per_mm2; ///< 3 x nodes
  Eigen::VectorXd powerDensity_W_per_mm3;
};

/// Resistances of the deformed block under the law of the field: quadratic tetrahedra on the displaced nodes of the
/// solver's mesh, the fields of the electrodes themselves and of their mirror images taken off in closed form. Lower
/// electrodes go with the rubber or are held, as the design says. What the mesh gives at rest is replaced by the closed
/// form (model/FieldAtRest.h), so that its errors cancel: P = P_box + P_mesh(state) - P_mesh(rest).
/// Threads may share it.
class ConductionField {
public:
  /// Throws DesignError where the design has another law, or a pressure law.
  explicit ConductionField(HyperelasticProblem problem);
  ~ConductionField();

  /// None: stopped. Throws DesignError where the load turns elements inside out. The same bytes at any number of
  /// threads (0: all cores).
  [[nodiscard]] std::optional<TerminalNetwork> network(const LoadIncrement& state, int threads = 0,
                                                       const std::stop_token& stop = {}) const;
  /// The same of a state that is known by the displacements [mm] of all nodes and of the electrodes.
  [[nodiscard]] std::optional<TerminalNetwork> network(const Eigen::Matrix3Xd& displacements_mm,
                                                       const ElectrodeDisplacements& electrodes, int threads = 0,
                                                       const std::stop_token& stop = {}) const;
  /// None: stopped.
  [[nodiscard]] std::optional<CurrentField> current(const LoadIncrement& state, int rowWire, int columnWire,
                                                    int threads = 0, const std::stop_token& stop = {}) const;

private:
  struct State;
  std::unique_ptr<State> state_;
};

} // namespace palp
