#include "app/study/reports/ReportPage.h"
#include "app/study/reports/stability/StabilityRow.h"
#include "model/base/Text.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

/// Newton stops at 1e-9 of the load, whose norm over all nodes may be several times an indenter's force.
constexpr double kContactAllowed = 1e-6;
constexpr double kLightestTouch_N = 1e-6;

/// Extremes of indenters. A result is checked by what holds for any contact: the clamped face bears what the indenters
/// press with, they press with the prescribed force, and nothing pulls.
class ContactCases {
public:
  ContactCases(StabilityCases& cases, const ReportRequest& request, StageLog& stages)
      : cases_(cases), request_(request), stages_(stages), block_mm_(request.design.block_mm),
        centre_mm_(block_mm_.head<2>() / 2),
        strength_N_(request.design.material.shearModulus_MPa() * block_mm_.z() * block_mm_.z()) {
    newton_.threads = request.threads;
  }

  void addAll() {
    const double h = block_mm_.z();
    for (const double radius : {0.05, 0.5, 5., 500., 1e5})
      add("size of a sphere", text(radius) + " mm",
          {{IndenterShape::Sphere, radius, 0, centre_mm_, 0, Motion{std::min(0.02 * h, radius), {0, 0}}}});
    for (const double friction : {0., 0.01, 0.3, 1., 2.}) {
      const double tangential = 0.05 * std::min(1., friction) * strength_N_;
      add("friction", "mu = " + text(friction), {sphere(centre_mm_, friction, {tangential, 0, -0.1 * strength_N_})});
    }
    add("first touch", text(kLightestTouch_N) + " N", {sphere(centre_mm_, 0, {0, 0, -kLightestTouch_N})});
    add("first touch", text(kLightestTouch_N) + " N, mu = 0.5",
        {sphere(centre_mm_, 0.5, {0.2 * kLightestTouch_N, 0, -kLightestTouch_N})});
    add("edge and corner", "sphere on an edge", {sphere({0, centre_mm_.y()}, 0, {0, 0, -0.02 * strength_N_})});
    add("edge and corner", "sphere on a corner", {sphere({0, 0}, 0, {0, 0, -0.01 * strength_N_})});
    add("edge and corner", "punch over an edge",
        {{IndenterShape::Flat,
          0.6 * h,
          0.06 * h,
          {block_mm_.x() - 0.2 * h, centre_mm_.y()},
          0,
          Motion{0.04 * h, {0, 0}}}});
    for (const double apart : {0.2, 0.6, 1.2})
      add("two touches that merge", text(apart * h) + " mm apart",
          {sphere(centre_mm_ - Eigen::Vector2d(apart * h / 2, 0), 0, {0, 0, -0.1 * strength_N_}),
           sphere(centre_mm_ + Eigen::Vector2d(apart * h / 2, 0), 0, {0, 0, -0.1 * strength_N_})});
    add("deep", "sphere of 0.6 h, a fifth of the block deep",
        {{IndenterShape::Sphere, 0.6 * h, 0, centre_mm_, 0, Motion{0.2 * h, {0, 0}}}});
    add("slides", "by a fifth of the block's height, mu = 0.6",
        {{IndenterShape::Sphere, h, 0, centre_mm_, 0.6, Motion{0.06 * h, {0.2 * h, 0}}}});
  }

private:
  Indenter sphere(const Eigen::Vector2d& place_mm, double friction, const Eigen::Vector3d& force_N) const {
    return {IndenterShape::Sphere, block_mm_.z(), 0, place_mm, friction, Press{force_N}};
  }

  void add(const std::string& group, const std::string& what, const std::vector<Indenter>& indenters) {
    cases_.add("contact: " + group, what, [&](StabilityRow& row) {
      LoadCase load;
      load.indenters = indenters;
      const HyperelasticProblem problem(
          request_.design, sensorMesh(request_.design, meshFor(request_.design, load, request_.mesh), cases_.stop()));
      check(row, load, stages_.measure("solve", [&] {
        return problem.solve(load, newton_, {.step = {}, .stop = cases_.stop()});
      }));
    });
  }

  static void check(StabilityRow& row, const LoadCase& load, const Solution& solution) {
    row.iterations = solution.iterations();
    row.errorOf = "the reaction, the prescribed force, and no pull";
    Eigen::Vector3d sum = solution.reaction_N;
    double scale = 0, worst = 0;
    int fewest = kFewTouchingNodes;
    for (std::size_t k = 0; k < solution.state().indenters.size(); ++k) {
      const IndenterState& state = solution.state().indenters[k];
      const Eigen::Vector3d& force = state.force_N;
      sum += force;
      scale += force.norm();
      fewest = std::min(fewest, state.touchingNodes);
      const Press* press = load.indenters[k].press();
      if (press && solution.converged) {
        Eigen::Vector3d missed = force - press->force_N;
        if (load.indenters[k].friction == 0)
          missed.head<2>().setZero(); // it is held tangentially by whatever force that takes
        worst = std::max(worst, missed.norm() / press->force_N.norm());
      }
    }
    worst = std::max(worst, scale > 0 ? sum.norm() / scale : 0);
    for (Eigen::Index node = 0; node < solution.state().contactTraction_MPa.cols(); ++node)
      if (solution.state().contactTraction_MPa(2, node) > 1e-9) worst = std::max(worst, 1.); // it pulls the top up
    row.error = worst;
    judge(row, kContactAllowed);
    if (row.outcome != StabilityOutcome::Right) return;
    if (!solution.converged) {
      row.outcome = StabilityOutcome::Stopped;
      row.words = "reached load fraction " + shortNumber(solution.reachedLoadFraction) + " in equilibrium; " +
                  solution.stopReason;
    } else if (fewest < kFewTouchingNodes) {
      row.outcome = StabilityOutcome::Warned;
      row.words = "only " + std::to_string(fewest) + " nodes of the mesh touch it";
    }
  }

  StabilityCases& cases_;
  const ReportRequest& request_;
  StageLog& stages_;
  Eigen::Vector3d block_mm_;
  Eigen::Vector2d centre_mm_;
  double strength_N_; ///< shear modulus times the height squared
  NewtonOptions newton_;
};

} // namespace

void addContactCases(StabilityCases& cases, const ReportRequest& request, StageLog& stages) {
  ContactCases(cases, request, stages).addAll();
}

} // namespace palp
