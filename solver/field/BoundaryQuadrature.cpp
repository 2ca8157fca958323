#include "solver/field/BoundaryQuadrature.h"

#include "solver/element/LaneKernels.h"

#include <Eigen/Dense>

#include <numbers>
#include <vector>

namespace palp {

namespace {

/// Points of a rule on a triangle that go over into each other by exchanging corners; the third coordinate is
/// 1 - a - b.
struct Orbit {
  double weight, a, b;
};

/// 25 points, exact to degree 10 (D. A. Dunavant, High degree efficient symmetrical Gaussian quadrature rules for the
/// triangle, 1985). The flux of a source and its mirror image through the dented face that they are mirrored in has a
/// peak as wide as the electrode is deep, about a face of the default mesh: degree 5 leaves 9 % of d ln R (floating),
/// degree 8 1.3 %, this one 0.2 %.
constexpr Orbit kOrbits[] = {{0.090817990382754, 1. / 3, 1. / 3},
                             {0.036725957756467, 0.485577633383657, 0.485577633383657},
                             {0.045321059435528, 0.109481575485037, 0.109481575485037},
                             {0.072757916845420, 0.141707219414880, 0.307939838764121},
                             {0.028327242531057, 0.025003534762686, 0.246672560639903},
                             {0.009421666963733, 0.009540815400299, 0.066803251012200}};
constexpr int kPoints = BoundaryQuadrature::pointsAFace;

/// Weights of sum 1, and the quadratic shape functions at the points with their derivatives by the first two
/// barycentric coordinates.
struct TriangleRule {
  Eigen::Matrix<double, kPoints, 1> weights;
  Eigen::Matrix<double, 6, kPoints> shapes, byFirst, bySecond;
  Eigen::Matrix<double, 8, kPoints> padded; ///< shapes and zeros

  TriangleRule() {
    Eigen::Index i = 0;
    const auto add = [&](double weight, double a, double b) {
      const double c = 1 - a - b;
      weights(i) = weight;
      shapes.col(i) << a * (2 * a - 1), b * (2 * b - 1), c * (2 * c - 1), 4 * a * b, 4 * b * c, 4 * c * a;
      byFirst.col(i) << 4 * a - 1, 0, 1 - 4 * c, 4 * b, -4 * b, 4 * (c - a);
      bySecond.col(i++) << 0, 4 * b - 1, 1 - 4 * c, 4 * a, 4 * (c - b), -4 * a;
    };
    for (const auto& [weight, a, b] : kOrbits) {
      const double c = 1 - a - b;
      add(weight, a, b);
      if (a == 1. / 3) continue;
      add(weight, b, c);
      add(weight, c, a);
      if (a == b) continue;
      add(weight, b, a);
      add(weight, a, c);
      add(weight, c, b);
    }
    padded << shapes, Eigen::Matrix<double, 2, kPoints>::Zero();
  }
};

const TriangleRule& triangleRule() {
  static const TriangleRule rule;
  return rule;
}

} // namespace

BoundaryQuadrature::BoundaryQuadrature(const Eigen::MatrixXi& faces, const Eigen::Matrix3Xd& nodes_mm)
    : at_(faces.cols() * kPoints, 6) {
  const TriangleRule& rule = triangleRule();
  for (Eigen::Index f = 0; f < faces.cols(); ++f) {
    Eigen::Matrix<double, 3, 6> nodes;
    for (int n = 0; n < 6; ++n) nodes.col(n) = nodes_mm.col(faces(n, f));
    for (Eigen::Index i = 0; i < kPoints; ++i) {
      // Corners run counter-clockwise seen from outside, and so do the tangents by the first two coordinates.
      const Eigen::Vector3d first = nodes * rule.byFirst.col(i), second = nodes * rule.bySecond.col(i);
      at_.row(f * kPoints + i).head<3>() = (nodes * rule.shapes.col(i)).transpose();
      at_.row(f * kPoints + i).tail<3>() = (rule.weights(i) / 2 * first.cross(second)).transpose();
    }
  }
}

void BoundaryQuadrature::sources(const Eigen::Matrix3Xd& sources_mm, int first, int count, double* potential,
                                 double* flux) const {
  const Eigen::Index from = Eigen::Index(first) * kPoints, points = Eigen::Index(count) * kPoints;
  Eigen::Map<Eigen::VectorXd> potentials(potential, points), fluxes(flux, points);
  potentials.setZero();
  fluxes.setZero();
  const auto part = [&](Eigen::Index k) { return at_.col(k).data() + from; };
  const SurfacePoints surface{part(0), part(1), part(2), part(3), part(4), part(5), points};
  for (Eigen::Index m = 0; m < sources_mm.cols(); ++m)
    laneKernels().addPointSource(surface, sources_mm.col(m).data(), potential, flux);
  potentials /= 4 * std::numbers::pi;
  fluxes /= 4 * std::numbers::pi;
}

Eigen::Matrix<double, 6, 1> BoundaryQuadrature::onShapes(const double* points) {
  Eigen::Matrix<double, 8, 1> sums;
  laneKernels().eightSums(triangleRule().padded.data(), points, kPoints, sums.data());
  return sums.head<6>();
}

Eigen::Matrix<double, 3, 1> BoundaryQuadrature::onCorners(const double* points) {
  const Eigen::Matrix<double, 6, 1> shapes = onShapes(points);
  const auto middles = shapes.tail<3>();
  return shapes.head<3>() + 0.5 * (middles + Eigen::Vector3d(middles(2), middles(0), middles(1)));
}

Eigen::Matrix<double, kPoints, 1> BoundaryQuadrature::atPoints(const Eigen::Matrix<double, 6, 1>& nodes) {
  return triangleRule().shapes.transpose() * nodes;
}

} // namespace palp
