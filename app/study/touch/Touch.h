#pragma once

#include "app/study/StageLog.h"
#include "model/FieldAtRest.h"
#include "model/LoadCase.h"
#include "model/RowColumnResistance.h"
#include "model/SensorDesign.h"
#include "solver/ConductionField.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <memory>
#include <optional>
#include <vector>

namespace palp {

/// How far along the chain from the design to the resistances; each needs those before it.
enum class Stage { Design, Mesh, Solution, Displacements, Resistances };

/// One touch, computed from the design to the resistances, no farther than requested: a change drops what comes after
/// it. Another law of the resistances leaves the deformation as it is where it asks for the same mesh (finerForField,
/// finerForPressure), another read-out the field too. The mesh is finer at the rims of the load's discs. Copies are
/// cheap (results are shared and never changed), so that a background job takes a copy, advances it and hands it back.
class Touch {
public:
  explicit Touch(SensorDesign design = paperDesign(), LoadCase load = {}, MeshOptions meshOptions = {});

  void setDesign(const SensorDesign& design);
  /// `path`: loads that its indenters follow after this one, one after another (model/LoadCase.h). Load fractions of
  /// what is found go on above 1: one more a step.
  void setLoad(const LoadCase& load, const std::vector<LoadCase>& path = {});
  void setMeshOptions(const MeshOptions& options);
  /// A mesh made elsewhere (meshForAccuracy) in place of the one the options make.
  void setMesh(Mesh mesh);

  /// Computes what is missing up to the stage. False where the solve did not converge or was cancelled: the last
  /// converged state is kept and later stages speak of it. Throws DesignError where design, mesh or load cannot be, and
  /// Cancelled where it is stopped while it meshes or while it finds resistances under the law of the field.
  bool advance(Stage target, const NewtonOptions& options = {}, const NewtonObserver& observer = {});

  [[nodiscard]] Stage reached() const;
  [[nodiscard]] const SensorDesign& design() const { return design_; }
  [[nodiscard]] const LoadCase& load() const { return load_; }
  [[nodiscard]] const std::vector<LoadCase>& path() const { return path_; }
  [[nodiscard]] const MeshOptions& meshOptions() const { return meshOptions_; }
  [[nodiscard]] const StageLog& stages() const { return stages_; }

  // Null until the stage was reached.
  [[nodiscard]] const Mesh* mesh() const { return mesh_.get(); }
  [[nodiscard]] const HyperelasticProblem* problem() const { return problem_.get(); }
  [[nodiscard]] const Solution* solution() const { return solution_.get(); }
  [[nodiscard]] const ElectrodeDisplacements* displacements() const { return displacements_.get(); }
  [[nodiscard]] const Eigen::MatrixXd* resistances_ohm() const { return resistances_.get(); }
  /// Under the law of the field alone: what any read-out is made of, and the field itself.
  [[nodiscard]] const TerminalNetwork* network() const { return network_.get(); }
  [[nodiscard]] const ConductionField* field() const { return field_.get(); }

private:
  void dropFrom(Stage stage);
  void setLaw(const SensorDesign& design);
  void findNetwork(const NewtonOptions& options, const NewtonObserver& observer);
  [[nodiscard]] Solution solve(const NewtonOptions& options, const NewtonObserver& observer) const;
  /// The load and what follows it.
  [[nodiscard]] std::vector<LoadCase> loads() const;
  /// The options with the load's discs in place of theirs.
  [[nodiscard]] MeshOptions meshing() const;

  SensorDesign design_;
  LoadCase load_;
  std::vector<LoadCase> path_; ///< after the load
  MeshOptions meshOptions_;
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<const HyperelasticProblem> problem_;
  std::shared_ptr<const Solution> solution_;
  std::shared_ptr<const ElectrodeDisplacements> displacements_;
  std::shared_ptr<const ConductionField> field_;
  std::shared_ptr<const TerminalNetwork> network_;
  std::shared_ptr<const Eigen::MatrixXd> resistances_;
  StageLog stages_;
};

} // namespace palp
