#include "app/study/touch/Touch.h"

#include "app/study/touch/TouchPath.h"
#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "model/base/Cancelled.h"

namespace palp {

namespace {

/// The mesh depends on the block, the areas, the upper electrodes and the field's needs; all else leaves it as it
/// is.
bool sameMesh(const SensorDesign& a, const SensorDesign& b) {
  return a.block_mm == b.block_mm && a.areas == b.areas && a.upper == b.upper && finerForField(a) == finerForField(b) &&
         finerForPressure(a) == finerForPressure(b);
}

/// One field, of which any read-out can be read.
bool sameButForReadout(const SensorDesign& a, const SensorDesign& b) {
  if (a.field() == nullptr || b.field() == nullptr || a.pressureLaw != b.pressureLaw) return false;
  FieldLaw other = *b.field();
  other.readout = a.field()->readout;
  return *a.field() == other;
}

} // namespace

Touch::Touch(SensorDesign design, LoadCase load, MeshOptions meshOptions)
    : design_(std::move(design)), load_(std::move(load)), meshOptions_(std::move(meshOptions)) {}

void Touch::setDesign(const SensorDesign& design) {
  if (design == design_) return;
  if (sameButForLaw(design, design_) && (!mesh_ || meshOptions_.mapped || sameMesh(design, design_))) {
    setLaw(design);
    return;
  }
  dropFrom(sameMesh(design, design_) ? Stage::Solution : Stage::Mesh);
  problem_.reset(); // these hold the design
  field_.reset();
  design_ = design;
}

void Touch::setLaw(const SensorDesign& design) {
  const bool sameField = sameButForReadout(design, design_);
  design_ = design;
  resistances_.reset();
  if (problem_) problem_ = std::make_shared<const HyperelasticProblem>(problem_->withLawOf(design));
  if (sameField) return;
  network_.reset();
  field_.reset();
}

void Touch::setLoad(const LoadCase& load, const std::vector<LoadCase>& path) {
  if (load == load_ && path == path_) return;
  const MeshOptions before = meshing();
  load_ = load;
  path_ = path;
  dropFrom(meshing() == before ? Stage::Solution : Stage::Mesh);
}

std::vector<LoadCase> Touch::loads() const {
  std::vector<LoadCase> all{load_};
  all.insert(all.end(), path_.begin(), path_.end());
  return all;
}

Solution Touch::solve(const NewtonOptions& options, const NewtonObserver& observer) const {
  return path_.empty() ? problem_->solve(load_, options, observer)
                       : joined(problem_->solvePath(loads(), options, observer));
}

void Touch::setMeshOptions(const MeshOptions& options) {
  if (options == meshOptions_) return;
  dropFrom(Stage::Mesh);
  meshOptions_ = options;
}

MeshOptions Touch::meshing() const {
  if (path_.empty()) return meshFor(design_, load_, meshOptions_);
  return meshFor(design_, whyInvalid(loads(), design_) ? load_ : pathEnvelope(loads()), meshOptions_);
}

void Touch::setMesh(Mesh mesh) {
  dropFrom(Stage::Mesh);
  mesh_ = std::make_shared<const Mesh>(std::move(mesh));
}

bool Touch::advance(Stage target, const NewtonOptions& options, const NewtonObserver& observer) {
  requireValid(design_);
  if (const auto wrong = path_.empty() ? std::nullopt : whyInvalid(loads(), design_)) throw DesignError(*wrong);
  if (target >= Stage::Mesh && !mesh_)
    mesh_ = stages_.measure(
        "mesh", [&] { return std::make_shared<const Mesh>(sensorMesh(design_, meshing(), observer.stop)); });
  if (target >= Stage::Solution && !solution_) {
    if (!problem_)
      problem_ =
          stages_.measure("factorise", [&] { return std::make_shared<const HyperelasticProblem>(design_, *mesh_); });
    solution_ = stages_.measure("solve", [&] { return std::make_shared<const Solution>(solve(options, observer)); });
  }
  if (target >= Stage::Displacements && !displacements_)
    displacements_ = std::make_shared<const ElectrodeDisplacements>(problem_->electrodes(solution_->state()));
  if (target >= Stage::Resistances && !resistances_ && design_.field())
    findNetwork(options, observer);
  else if (target >= Stage::Resistances && !resistances_)
    resistances_ = std::make_shared<const Eigen::MatrixXd>(rowColumnResistances(design_, *displacements_));
  return target < Stage::Solution || solution_->converged;
}

void Touch::findNetwork(const NewtonOptions& options, const NewtonObserver& observer) {
  if (!network_) {
    auto network = stages_.measure("field", [&] {
      if (!field_) field_ = std::make_shared<const ConductionField>(*problem_);
      return field_->network(solution_->state(), options.threads, observer.stop);
    });
    if (!network) throw Cancelled();
    network_ = std::make_shared<const TerminalNetwork>(std::move(*network));
  } else if (design_.pressureLaw) {
    ConductionField::requirePositive(*network_, design_.field()->readout); // another read-out of it
  }
  resistances_ =
      std::make_shared<const Eigen::MatrixXd>(NetworkReading(*network_, design_.field()->readout).resistances_ohm());
}

Stage Touch::reached() const {
  if (resistances_) return Stage::Resistances;
  if (displacements_) return Stage::Displacements;
  if (solution_) return Stage::Solution;
  return mesh_ ? Stage::Mesh : Stage::Design;
}

void Touch::dropFrom(Stage stage) {
  resistances_.reset();
  network_.reset();
  displacements_.reset();
  solution_.reset();
  if (stage > Stage::Mesh) return;
  problem_.reset();
  field_.reset();
  mesh_.reset();
}

} // namespace palp
