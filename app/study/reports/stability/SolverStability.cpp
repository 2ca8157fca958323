#include "app/study/reports/MeshShare.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/stability/StabilityRow.h"
#include "solver/IndependentResidual.h"

#include "model/base/Text.h"
#include "solver/HyperelasticProblem.h"
#include "solver/MeshQuality.h"
#include "solver/PointProbe.h"
#include "solver/SensorMesh.h"

#include <cmath>
#include <optional>

namespace palp {

namespace {

/// Newton stops at 1e-9 of the load, and its last iteration often lands far below; the check sums in another order.
constexpr double kResidualAllowed = 1e-8;

LoadCase onArea(int area, const Eigen::Vector3d& force_N) {
  LoadCase load;
  load.areas.push_back({area, force_N});
  return load;
}

std::string words(const Eigen::Vector3d& force_N) {
  return "(" + text(force_N.x()) + ", " + text(force_N.y()) + ", " + text(force_N.z()) + ") N";
}

double difference(const Eigen::Matrix3Xd& a, const Eigen::Matrix3Xd& b) {
  return (a - b).norm() / b.norm();
}

/// The cases of the solver on one coarse mapped mesh, so that dozens take seconds.
class SolverCases {
public:
  SolverCases(StabilityCases& cases, const ReportRequest& request, StageLog& stages)
      : cases_(cases), request_(request), stages_(stages), quick_(request.mesh.mapped.has_value()) {
    mesh_ = request.mesh;
    if (!quick_) mesh_.mapped = std::array<int, 3>{12, 12, 6};
    tets_.meshSize_mm = (quick_ ? 12 : 6) * meshShare(request.design);
    newton_.threads = request.threads;
  }

  void addAll() {
    incompressible();
    incompressibleTets();
    scaledModuli();
    shapes();
    areas();
    largeForces();
    rest();
    otherMaterials();
    brokenMesh();
    defaultMesh();
  }

private:
  Solution solve(const HyperelasticProblem& problem, const LoadCase& load) {
    return stages_.measure("solve", [&] { return problem.solve(load, newton_, {.step = {}, .stop = cases_.stop()}); });
  }

  /// Solves and checks the state reached against the independent residual.
  Solution check(StabilityRow& row, const SensorDesign& design, const LoadCase& load, const MeshOptions& options) {
    requireValid(design);
    const HyperelasticProblem problem(design, sensorMesh(design, options));
    Solution solution = solve(problem, load);
    row.iterations = solution.iterations();
    row.error = independentResidual(design, problem.mesh(), load, solution);
    row.errorOf = "equilibrium, computed independently";
    judge(row, kResidualAllowed);
    if (!solution.converged && row.outcome == StabilityOutcome::Right) {
      row.outcome = StabilityOutcome::Stopped;
      row.words = "reached load fraction " + shortNumber(solution.reachedLoadFraction) + " in equilibrium; " +
                  solution.stopReason;
    }
    return solution;
  }

  void incompressible() {
    for (const double nu : {0.3, 0.4, 0.45, 0.49, 0.499, 0.4999, 0.49999, 0.499999, 0.4999999, 0.5})
      cases_.add("Poisson's ratio", "nu = " + text(nu), [&](StabilityRow& row) {
        SensorDesign design = request_.design;
        design.material.poissonRatio = nu;
        check(row, design, typical_, mesh_);
      });
  }

  /// The incompressible block on tetrahedra, against the nearly incompressible one.
  void incompressibleTets() {
    cases_.add("Poisson's ratio", "nu = 0.5 on 10-node tetrahedra", [&](StabilityRow& row) {
      SensorDesign design = request_.design;
      design.material.poissonRatio = 0.4999999;
      const HyperelasticProblem nearly(design, sensorMesh(design, tets_));
      design.material.poissonRatio = 0.5;
      const HyperelasticProblem fully(design, sensorMesh(design, tets_));
      const Solution solution = solve(fully, typical_);
      row.iterations = solution.iterations();
      row.error = difference(solution.state().displacements_mm, solve(nearly, typical_).state().displacements_mm);
      row.errorOf = "nu = 0.4999999";
      judge(row, 1e-5); // p/kappa is 1e-7 of the strains' scale, and the block is thin
    });
  }

  void scaledModuli() {
    const HyperelasticProblem base(request_.design, sensorMesh(request_.design, mesh_));
    const LoadCase small = onArea(0, {0.2, -0.2, -0.9}); // times 1e6 it is just below the largest force allowed
    const Eigen::Matrix3Xd wanted = solve(base, small).state().displacements_mm;
    for (const double scale : {1e-6, 1e-4, 1e-2, 1e2, 1e4, 1e6})
      cases_.add("moduli and load scaled alike", "by " + text(scale), [&](StabilityRow& row) {
        SensorDesign design = request_.design;
        design.material.law = timesStress(design.material.law, scale);
        LoadCase load = small;
        load.areas[0].force_N *= scale;
        const HyperelasticProblem problem(design, sensorMesh(design, mesh_));
        const Solution solution = solve(problem, load);
        row.iterations = solution.iterations();
        row.error = difference(solution.state().displacements_mm, wanted);
        row.errorOf = "the same displacements";
        judge(row, 1e-9); // the problem is the same but for rounding and where Newton stops
      });
  }

  SensorDesign withThickness(double thickness_mm) const {
    SensorDesign design = request_.design;
    const double factor = thickness_mm / design.block_mm.z();
    design.block_mm.z() = thickness_mm;
    for (ElectrodeLayer* layer : {&design.upper, &design.lower})
      for (std::vector<double>& depths : layer->z_mm)
        for (double& z : depths) z *= factor;
    return design;
  }

  void shapes() {
    for (const double thickness : {0.5, 1.0, 2.0, 10.0, 30.0})
      cases_.add("thickness", text(thickness) + " mm",
                 [&](StabilityRow& row) { check(row, withThickness(thickness), typical_, mesh_); });
    using Counts = std::array<int, 3>;
    for (const Counts& counts : {Counts{40, 40, 1}, Counts{2, 2, 24}, Counts{30, 2, 4}, Counts{1, 1, 1}})
      cases_.add("aspect of elements",
                 std::to_string(counts[0]) + "x" + std::to_string(counts[1]) + "x" + std::to_string(counts[2]),
                 [&](StabilityRow& row) {
                   MeshOptions mesh;
                   mesh.mapped = counts;
                   check(row, request_.design, typical_, mesh);
                 });
    for (const double depth : {1e-2, 1e-4, 1e-6})
      cases_.add("slivers", "electrodes " + text(depth) + " mm under the loaded face",
                 [&](StabilityRow& row) { slivers(row, depth); });
  }

  /// Tetrahedra around electrodes almost in the face, against the mesh of the design itself, read 1 mm under the face.
  void slivers(StabilityRow& row, double depth_mm) {
    SensorDesign design = request_.design;
    design.upper.z_mm = {{design.block_mm.z() - depth_mm}};
    const HyperelasticProblem poor(design, sensorMesh(design, tets_));
    const HyperelasticProblem good(request_.design, sensorMesh(request_.design, tets_));
    const Solution solution = solve(poor, typical_);
    const Eigen::Matrix3Xd places = request_.design.upperElectrodes_mm();
    row.iterations = solution.iterations();
    row.error = difference(PointProbe(poor.mesh(), places).displacements_mm(solution.state()),
                           PointProbe(good.mesh(), places).displacements_mm(solve(good, typical_).state()));
    row.errorOf = "the design's own mesh";
    judge(row, 0.3); // two coarse meshes differ by their discretisation errors, some 10 % each
    const MeshQuality quality = meshQuality(poor.mesh());
    if (row.words.empty())
      row.words = "dihedral angles from " + shortNumber(quality.minDihedral_deg) + " to " +
                  shortNumber(quality.maxDihedral_deg) + " deg";
    if (!solution.converged) {
      row.outcome = StabilityOutcome::Stopped;
      row.words += "; " + solution.stopReason;
    }
  }

  void areas() {
    cases_.add("areas", "all six together, (0.5, -0.5, -6) N each", [&](StabilityRow& row) {
      LoadCase load;
      for (int area = 0; area < request_.design.areas.count(); ++area) load.areas.push_back({area, {0.5, -0.5, -6}});
      check(row, request_.design, load, mesh_);
    });
    for (const int strips : {30, 50})
      cases_.add("areas",
                 std::to_string(strips) +
                     " strips thinner than an element, against the whole face", // words: ok, a name in the CSV
                 [&](StabilityRow& row) { thinAreas(row, strips); });
  }

  /// Strips that bear equal tractions are the same load as one area over the complete face.
  void thinAreas(StabilityRow& row, int strips) {
    SensorDesign thin = request_.design, whole = request_.design;
    thin.areas = {strips, 1};
    whole.areas = {1, 1};
    const Eigen::Vector3d force_N(3, -2, -20);
    LoadCase load;
    for (int area = 0; area < strips; ++area) load.areas.push_back({area, force_N / strips});
    const HyperelasticProblem fine(thin, sensorMesh(thin, mesh_));
    const HyperelasticProblem one(whole, sensorMesh(whole, mesh_));
    const Solution solution = solve(fine, load);
    row.iterations = solution.iterations();
    row.error = difference(solution.state().displacements_mm, solve(one, onArea(0, force_N)).state().displacements_mm);
    row.errorOf = "the whole face loaded"; // words: ok, a name in the CSV
    judge(row, 1e-9);                      // the same nodal forces but for rounding
  }

  void largeForces() {
    for (const double force : {5.0, 10.0, 20.0, 30.0}) force_N("shear", {force, 0, 0});
    for (const double force : {-6.0, -20.0, -60.0, -100.0, -150.0, -300.0, -1000.0})
      force_N("compression", {0, 0, force});
    for (const double force : {6.0, 20.0, 60.0, 150.0}) force_N("tension", {0, 0, force});
    force_N("shear and compression", {3, 3, -60});
  }

  void force_N(const std::string& group, const Eigen::Vector3d& force) {
    cases_.add(group, words(force) + " on area 0",
               [&](StabilityRow& row) { check(row, request_.design, onArea(0, force), mesh_); });
  }

  void rest() {
    cases_.add("load reversal", "a load, its reverse, then none: back at rest", [&](StabilityRow& row) {
      const HyperelasticProblem problem(request_.design, sensorMesh(request_.design, mesh_));
      const Eigen::Matrix3Xd first = solve(problem, typical_).state().displacements_mm;
      LoadCase reverse = typical_;
      reverse.areas[0].force_N *= -1;
      row.iterations = solve(problem, reverse).iterations();
      const double atRest_mm = solve(problem, onArea(0, Eigen::Vector3d::Zero())).state().displacements_mm.norm();
      row.error = std::max(atRest_mm, difference(solve(problem, typical_).state().displacements_mm, first));
      row.errorOf = "rest [mm], and the first answer again";
      judge(row, 1e-9);
    });
  }

  /// Of Mooney-Rivlin rubber: the other laws have no c01.
  void otherMaterials() {
    const auto* given = std::get_if<MooneyRivlin>(&request_.design.material.law);
    if (given == nullptr) return;
    for (const double c01 : {0.0, -0.05, -0.2, -0.3, -0.4})
      cases_.add("material", "c01 = " + text(c01) + " MPa", [&, given](StabilityRow& row) {
        SensorDesign design = request_.design;
        design.material.law = MooneyRivlin{given->c10_MPa, c01};
        check(row, design, typical_, mesh_);
      });
  }

  void brokenMesh() {
    cases_.add("inverted elements", "a node of the mesh pushed through the element below", [&](StabilityRow& row) {
      Mesh mesh = sensorMesh(request_.design, mesh_);
      Eigen::Index top = 0;
      mesh.nodes_mm.row(2).maxCoeff(&top);
      mesh.nodes_mm(2, top) = -1;
      const HyperelasticProblem problem(request_.design, mesh); // throws DesignError: refused
      row.outcome = StabilityOutcome::Wrong;
      row.words = "the mesh was taken as it is (" + std::to_string(problem.dof()) + " unknowns)";
    });
  }

  /// Tetrahedra with a bubble and a linear pressure, and hexahedra with a constant one, share nothing but the theory.
  void defaultMesh() {
    const auto add = [this](const std::string& what, const SensorDesign& design, const LoadCase& load) {
      cases_.add("default mesh", what, [&](StabilityRow& row) { againstHexahedra(row, design, load); });
    };
    for (const double nu : {0.3, 0.4999999, 0.5}) {
      SensorDesign design = request_.design;
      design.material.poissonRatio = nu;
      add("nu = " + text(nu), design, typical_);
    }
    for (const double thickness : {1.0, 30.0}) add(text(thickness) + " mm thick", withThickness(thickness), typical_);
    if (quick_) return; // few hexahedra are a poor reference for large forces
    for (const Eigen::Vector3d& force :
         {Eigen::Vector3d(30, 0, 0), Eigen::Vector3d(0, 0, 60), Eigen::Vector3d(0, 0, -60), Eigen::Vector3d(0, 0, -150),
          Eigen::Vector3d(3, 3, -60)})
      add(words(force) + " on area 0", request_.design, onArea(0, force));
  }

  /// Two meshes of hexahedra show how far they are from converged; the tetrahedra may be as far from the finer one.
  void againstHexahedra(StabilityRow& row, const SensorDesign& design, const LoadCase& load) {
    const MeshOptions& tets = quick_ ? tets_ : request_.mesh;
    MeshOptions finer = mesh_;
    for (int& count : *finer.mapped) count = count * 5 / 3;
    const HyperelasticProblem problem(design, sensorMesh(design, tets));
    const Solution solution = solve(problem, load);
    row.iterations = solution.iterations();
    if (!solution.converged) {
      row.outcome = StabilityOutcome::Stopped;
      row.words = "reached load fraction " + shortNumber(solution.reachedLoadFraction) + "; " + solution.stopReason;
      return;
    }
    const auto coarse = electrodesOf(design, load, mesh_), fine = electrodesOf(design, load, finer);
    if (!coarse || !fine) {
      row.outcome = StabilityOutcome::Warned;
      row.words = "converged, but the hexahedra that it is judged by did not";
      return;
    }
    const double allowed = 2 * difference(*coarse, *fine); // of first order in the size, 1.5 would be enough
    row.error = difference(problem.electrodes(solution.state()).upper_mm, *fine);
    row.errorOf = "electrodes of finer hexahedra; " + shortNumber(allowed) + " allowed, twice their own last step";
    judge(row, allowed);
  }

  /// Displacements [mm] of the upper electrodes; empty where the load is not reached.
  std::optional<Eigen::Matrix3Xd> electrodesOf(const SensorDesign& design, const LoadCase& load,
                                               const MeshOptions& options) {
    const HyperelasticProblem problem(design, sensorMesh(design, options));
    const Solution solution = solve(problem, load);
    if (!solution.converged) return {};
    return problem.electrodes(solution.state()).upper_mm;
  }

  StabilityCases& cases_;
  const ReportRequest& request_;
  StageLog& stages_;
  bool quick_;       ///< a coarse mesh is requested: a look at the report, not at the solver
  MeshOptions mesh_; ///< of hexahedra
  MeshOptions tets_;
  NewtonOptions newton_;
  LoadCase typical_ = onArea(0, {0.5, -0.5, -3});
};

} // namespace

void addSolverCases(StabilityCases& cases, const ReportRequest& request, StageLog& stages) {
  SolverCases(cases, request, stages).addAll();
}

} // namespace palp
