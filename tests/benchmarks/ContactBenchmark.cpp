// Contact beside closed forms. Prints a Markdown table.
//   contact_benchmark sphere: force of a sphere on a bonded layer, a/h 0.05 to 2, beside the layer's integral equation.
//   contact_benchmark punch: the same of flat punches with their rims.
//   contact_benchmark friction: a sphere pressed, then moved to and fro; u(Q) and the loop beside Cattaneo and Mindlin.
// Layers are blocks so wide that their sides are felt by far less than the differences.
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

using namespace palp;

namespace {

/// Gauss-Legendre on (0, 1), by the eigenvalues of the Jacobi matrix (Golub and Welsch 1969).
struct Rule {
  Eigen::VectorXd nodes, weights;
  explicit Rule(int n) {
    Eigen::MatrixXd jacobi = Eigen::MatrixXd::Zero(n, n);
    for (int k = 1; k < n; ++k) jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(jacobi);
    nodes = (eigen.eigenvalues().array() + 1) / 2;
    weights = eigen.eigenvectors().row(0).cwiseAbs2().transpose();
  }
};

/// A bonded layer under an axisymmetric indenter without friction: W. C. Hayes, L. M. Keer, G. Herrmann, L. F. Mockros,
/// Journal of Biomechanics 5, 1972. Small strain.
struct Layer {
  double shearModulus_MPa, poissonRatio, height_mm;

  /// phi + 2/pi int phi K = f on (0, a), for each column of f: values at the points x (in a, the last one is 1), whose
  /// weights are w.
  Eigen::MatrixXd solve(double a_mm, const Eigen::VectorXd& x, const Eigen::VectorXd& w,
                        const Eigen::MatrixXd& f) const {
    static const Rule rule(400);
    constexpr double furthest = 40; // where L - 1 has died out
    const double nu = poissonRatio;
    Eigen::MatrixXd kernel = Eigen::MatrixXd::Zero(x.size(), x.size());
    for (Eigen::Index q = 0; q < rule.nodes.size(); ++q) {
      const double o = furthest * rule.nodes(q), sh = std::sinh(o), ch = std::cosh(o);
      const double L = ((3 - 4 * nu) * sh * ch - o) / ((3 - 4 * nu) * sh * sh + o * o + 4 * (1 - nu) * (1 - nu));
      const Eigen::VectorXd wave = (o * a_mm / height_mm * x.array()).cos();
      kernel += a_mm / height_mm * furthest * rule.weights(q) * (L - 1) * wave * wave.transpose();
    }
    const Eigen::MatrixXd system =
        Eigen::MatrixXd::Identity(x.size(), x.size()) + 2 / std::numbers::pi * kernel * w.asDiagonal();
    return system.partialPivLu().solve(f);
  }

  /// Depth and force of a sphere whose contact has the radius a.
  std::pair<double, double> sphere(double R_mm, double a_mm) const {
    const Rule rule(80);
    Eigen::VectorXd x(81), w(81);
    x << rule.nodes, 1;
    w << rule.weights, 0;
    Eigen::MatrixXd f(81, 2);
    f << Eigen::VectorXd::Ones(81), -a_mm * a_mm / R_mm * x.cwiseAbs2();
    const Eigen::MatrixXd phi = solve(a_mm, x, w, f);
    const double depth_mm = -phi(80, 1) / phi(80, 0); // no pressure at the edge
    return {depth_mm, 4 * shearModulus_MPa * a_mm / (1 - poissonRatio) * w.dot(depth_mm * phi.col(0) + phi.col(1))};
  }

  /// Force of a flat punch with an arc for a rim at this depth, whose contact ends on the rim.
  double punch(double radius_mm, double rim_mm, double depth_mm) const {
    const Rule rule(100), inner(200);
    const double flat = radius_mm - rim_mm;
    const auto ofContact = [&](double a_mm) {
      Eigen::VectorXd x(201), w(201), f(201);
      x << flat / a_mm * rule.nodes, Eigen::VectorXd(flat / a_mm + (1 - flat / a_mm) * rule.nodes.array()), 1;
      w << flat / a_mm * rule.weights, (1 - flat / a_mm) * rule.weights, 0;
      for (Eigen::Index i = 0; i < x.size(); ++i) {
        const double at = a_mm * x(i);
        f(i) = depth_mm;
        if (at <= flat) continue;
        const double from = std::asin(flat / at), width = std::numbers::pi / 2 - from; // s = at sin t
        for (Eigen::Index q = 0; q < inner.nodes.size(); ++q) {
          const double up = at * std::sin(from + width * inner.nodes(q)) - flat;
          f(i) -= at * width * inner.weights(q) * up / std::sqrt(rim_mm * rim_mm - up * up);
        }
      }
      const Eigen::VectorXd phi = solve(a_mm, x, w, f);
      return std::pair{phi(200), 4 * shearModulus_MPa * a_mm / (1 - poissonRatio) * w.dot(phi)};
    };
    double low = flat * (1 + 1e-9), high = radius_mm * (1 - 1e-9);
    for (int i = 0; i < 30; ++i) {
      const double middle = (low + high) / 2;
      (ofContact(middle).first > 0 ? low : high) = middle;
    }
    return ofContact(low).second;
  }
};

SensorDesign layerOf(double height_mm, double width_mm) {
  SensorDesign design = paperDesign();
  design.block_mm = {width_mm, width_mm, height_mm};
  design.upper.z_mm = {{0.8 * height_mm}};
  design.lower.z_mm = {{0.2 * height_mm}};
  return design;
}

Layer closedFormOf(const SensorDesign& design) {
  return {design.material.shearModulus_MPa(), design.material.poissonRatio, design.block_mm.z()};
}

struct Solved {
  double force_N = 0, seconds = 0;
  int unknowns = 0;
};

Solved pressed(const SensorDesign& design, const Indenter& indenter) {
  const auto start = std::chrono::steady_clock::now();
  const LoadCase load{{}, {}, {indenter}};
  const HyperelasticProblem problem(design, sensorMesh(design, meshFor(design, load, {})));
  const Solution solution = problem.solve(load);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  if (!solution.converged) std::printf("not converged: %s\n", solution.stopReason.c_str());
  return {-solution.state().indenters[0].force_N.z(), time.count(), problem.dof()};
}

void spheres() {
  std::printf(
      "| a/h | sphere [mm] | depth [mm] | closed form [N] | force [N] | difference [%%] | unknowns | seconds |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const double ratio : {0.05, 0.1, 0.2, 0.4, 0.6, 1., 1.5, 2.}) {
    constexpr double h = 5, strain = 0.002;
    const double a = ratio * h, width = std::max(6 * h, 6 * a + 6 * h);
    const SensorDesign design = layerOf(h, width);
    const Layer layer = closedFormOf(design);
    const double R = layer.sphere(1, a).first / (strain * std::min(a, h)); // the depth goes with 1 / R
    const auto [depth, force] = layer.sphere(R, a);
    const Solved found =
        pressed(design, {IndenterShape::Sphere, R, 0, {width / 2, width / 2}, 0, Motion{depth, {0, 0}}});
    std::printf("| %.3g | %.4g | %.4g | %.5g | %.5g | %+.2f | %d | %.1f |\n", ratio, R, depth, force, found.force_N,
                100 * (found.force_N / force - 1), found.unknowns, found.seconds);
    std::fflush(stdout);
  }
}

void punches() {
  std::printf("| radius, rim [mm] | closed form [N] | force [N] | difference [%%] | unknowns | seconds |\n"
              "|---|---|---|---|---|---|\n");
  for (const auto& [radius, rim] : {std::pair{1., 0.02}, std::pair{1., 0.2}, std::pair{2., 0.2}, std::pair{2.5, 0.5},
                                    std::pair{3., 0.1}, std::pair{5., 0.2}}) {
    const double width = std::max(30., 12 * radius);
    const SensorDesign design = layerOf(5, width);
    const double force = closedFormOf(design).punch(radius, rim, 0.01);
    const Solved found =
        pressed(design, {IndenterShape::Flat, radius, rim, {width / 2, width / 2}, 0, Motion{0.01, {0, 0}}});
    std::printf("| %.3g, %.3g | %.5g | %.5g | %+.2f | %d | %.1f |\n", radius, rim, force, found.force_N,
                100 * (found.force_N / force - 1), found.unknowns, found.seconds);
    std::fflush(stdout);
  }
}

/// Simpson's rule over equal steps of x.
double integral(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < x.size(); i += 2) sum += (x[i + 2] - x[i]) / 6 * (y[i] + 4 * y[i + 1] + y[i + 2]);
  return sum;
}

void friction() {
  constexpr double R = 50, a = 1, mu = 0.5, most = 0.8; // most: of the force at which all slips
  constexpr int steps = 16;                             // a branch
  const SensorDesign design = layerOf(10, 40);
  const Layer layer = closedFormOf(design);
  const double P = layer.sphere(R, a).second, nu = layer.poissonRatio, G = layer.shearModulus_MPa;
  std::vector<double> Q; // in P mu: up, down, up
  for (int k = 0; k <= steps / 2; ++k) Q.push_back(2 * most * k / steps);
  for (int k = 1; k <= steps; ++k) Q.push_back(most - 2 * most * k / steps);
  for (int k = 1; k <= steps; ++k) Q.push_back(-most + 2 * most * k / steps);
  std::vector<LoadCase> path;
  for (const double q : Q)
    path.push_back({{}, {}, {{IndenterShape::Sphere, R, 0, {20, 20}, mu, Press{{mu * P * q, 0, -P}}}}});
  const HyperelasticProblem problem(design, sensorMesh(design, meshFor(design, path.front(), {})));
  const std::vector<Solution> found = problem.solvePath(path);
  if (found.size() != path.size() || !found.back().converged) {
    std::printf("not converged at step %zu: %s\n", found.size(), found.back().stopReason.c_str());
    return;
  }
  std::vector<double> u;
  for (const Solution& solution : found) u.push_back(solution.state().indenters[0].translation_mm.x());
  for (std::size_t k = u.size(); k-- > 0;) u[k] -= u.front();
  const double scale = 3 * mu * P * (2 - nu) / (16 * G * a);
  const auto closed = [&](double q) { return scale * (1 - std::pow(1 - q, 2. / 3)); };
  double along = 0, all = 0; // the layer's linear share, by least squares
  for (int k = 1; k <= steps / 2; ++k) {
    along += Q[static_cast<std::size_t>(k)] * (u[static_cast<std::size_t>(k)] - closed(Q[static_cast<std::size_t>(k)]));
    all += Q[static_cast<std::size_t>(k)] * Q[static_cast<std::size_t>(k)];
  }
  std::printf("%d unknowns; linear share of the layer %+.1f %% of the stuck half-space's\n\n", problem.dof(),
              100 * along / all / (2. / 3 * scale));
  std::printf(
      "| Q / (mu P) | closed form [mm] | u less the linear share [mm] | difference [%%] |\n|---|---|---|---|\n");
  for (int k = 1; k <= steps / 2; ++k) {
    const double q = Q[static_cast<std::size_t>(k)], less = u[static_cast<std::size_t>(k)] - along / all * q;
    std::printf("| %.2f | %.5g | %.5g | %+.2f |\n", q, closed(q), less, 100 * (less / closed(q) - 1));
  }
  std::vector<double> force, down, up;
  for (int k = 0; k <= steps; ++k) {
    force.push_back(mu * P * Q[static_cast<std::size_t>(steps / 2 + k)]);
    down.push_back(u[static_cast<std::size_t>(steps / 2 + k)]);
    up.push_back(u[static_cast<std::size_t>(steps / 2 + steps + (steps - k))]);
  }
  const double energy = std::abs(integral(force, down) - integral(force, up));
  const double expected = 9 * mu * mu * P * P * (2 - nu) / (10 * G * a) *
                          (1 - std::pow(1 - most, 5. / 3) - 5 * most / 6 * (1 + std::pow(1 - most, 2. / 3)));
  std::printf("\nenergy of the loop %.5g N mm, closed form %.5g N mm, %+.2f %%\n", energy, expected,
              100 * (energy / expected - 1));
}

} // namespace

int main(int count, char** words) {
  const std::string what = count > 1 ? words[1] : "";
  if (what == "sphere") return spheres(), 0;
  if (what == "punch") return punches(), 0;
  if (what == "friction") return friction(), 0;
  std::fprintf(stderr, "contact_benchmark: which? sphere, punch or friction\n");
  return 2;
}
