#include "app/study/touch/Touch.h"

namespace palp {

namespace {

/// The mesh knows the block, the areas and the upper electrodes; all else leaves it as it is.
bool sameMesh(const SensorDesign& a, const SensorDesign& b) {
  return a.block_mm == b.block_mm && a.areas == b.areas && a.upper == b.upper;
}

} // namespace

Touch::Touch(SensorDesign design, LoadCase load, MeshOptions meshOptions)
    : design_(std::move(design)), load_(std::move(load)), meshOptions_(std::move(meshOptions)) {}

void Touch::setDesign(const SensorDesign& design) {
  if (design == design_) return;
  dropFrom(sameMesh(design, design_) ? Stage::Solution : Stage::Mesh);
  problem_.reset(); // it holds the design
  design_ = design;
}

void Touch::setLoad(const LoadCase& load) {
  if (load == load_) return;
  const MeshOptions before = meshing();
  load_ = load;
  dropFrom(meshing() == before ? Stage::Solution : Stage::Mesh);
}

void Touch::setMeshOptions(const MeshOptions& options) {
  if (options == meshOptions_) return;
  dropFrom(Stage::Mesh);
  meshOptions_ = options;
}

MeshOptions Touch::meshing() const {
  MeshOptions options = meshOptions_;
  options.discs = options.mapped ? std::vector<FineDisc>{} : fineDiscs(load_);
  return options;
}

void Touch::setMesh(Mesh mesh) {
  dropFrom(Stage::Mesh);
  mesh_ = std::make_shared<const Mesh>(std::move(mesh));
}

bool Touch::advance(Stage target, const NewtonOptions& options, const NewtonObserver& observer) {
  requireValid(design_);
  if (target >= Stage::Mesh && !mesh_)
    mesh_ = stages_.measure(
        "mesh", [&] { return std::make_shared<const Mesh>(sensorMesh(design_, meshing(), observer.stop)); });
  if (target >= Stage::Solution && !solution_) {
    if (!problem_)
      problem_ =
          stages_.measure("factorise", [&] { return std::make_shared<const HyperelasticProblem>(design_, *mesh_); });
    solution_ = stages_.measure(
        "solve", [&] { return std::make_shared<const Solution>(problem_->solve(load_, options, observer)); });
  }
  if (target >= Stage::Displacements && !displacements_)
    displacements_ = std::make_shared<const ElectrodeDisplacements>(problem_->electrodes(solution_->state()));
  if (target >= Stage::Resistances && !resistances_)
    resistances_ = std::make_shared<const Eigen::MatrixXd>(rowColumnResistances(design_, *displacements_));
  return target < Stage::Solution || solution_->converged;
}

Stage Touch::reached() const {
  if (resistances_) return Stage::Resistances;
  if (displacements_) return Stage::Displacements;
  if (solution_) return Stage::Solution;
  return mesh_ ? Stage::Mesh : Stage::Design;
}

void Touch::dropFrom(Stage stage) {
  resistances_.reset();
  displacements_.reset();
  solution_.reset();
  if (stage > Stage::Mesh) return;
  problem_.reset();
  mesh_.reset();
}

} // namespace palp
