#include "solver/contact/ReducedContact.h"

#include "solver/contact/ContactSteps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace palp {
namespace {

constexpr double halfSpaceShear_MPa = 0.2, pointSpacing_mm = 0.11;
constexpr int pointsAside = 19; // points

/// The face of an incompressible half-space, in a square of points: what a unit force on one moves the others
/// (Boussinesq and Cerruti: (1 + r r^T / r^2) / (4 pi G r)), and itself, in the mean over its share of the face.
Eigen::MatrixXd halfSpace(const Eigen::Matrix3Xd& points_mm) {
  const Eigen::Index all = points_mm.cols();
  const double ownOverR = 4 * std::log(1 + std::numbers::sqrt2) / pointSpacing_mm; // 1 / r over a square
  Eigen::MatrixXd compliance(3 * all, 3 * all);
  for (Eigen::Index i = 0; i < all; ++i)
    for (Eigen::Index j = 0; j < all; ++j) {
      const Eigen::Vector3d r = points_mm.col(i) - points_mm.col(j);
      Eigen::Matrix3d moved = ownOverR * Eigen::Vector3d(1.5, 1.5, 1).asDiagonal();
      if (i != j) moved = (Eigen::Matrix3d::Identity() + r * r.transpose() / r.squaredNorm()) / r.norm();
      compliance.block<3, 3>(3 * i, 3 * j) = moved / (4 * std::numbers::pi * halfSpaceShear_MPa);
    }
  return compliance;
}

Eigen::Matrix3Xd squareOfPoints() {
  Eigen::Matrix3Xd points_mm(3, pointsAside * pointsAside);
  for (int i = 0; i < pointsAside; ++i)
    for (int j = 0; j < pointsAside; ++j)
      points_mm.col(pointsAside * i + j) << pointSpacing_mm * i, pointSpacing_mm * j, 0;
  return points_mm;
}

ContactTarget moved(double x_mm, double z_mm) {
  return {{false, false, false}, Eigen::Vector3d::Zero(), {x_mm, 0, z_mm}, 1};
}

} // namespace

/// Pressed, then moved aside in one step by far more than the points slip: most stick to the end.
TEST(ReducedContact, AnswersAWayAsideThatIsLongBesideTheSlip) {
  const Eigen::Matrix3Xd rest_mm = squareOfPoints();
  const Eigen::MatrixXd compliance = halfSpace(rest_mm);
  std::vector<ContactPoint> points;
  for (int i = 0; i < pointsAside * pointsAside; ++i) points.push_back({i, pointSpacing_mm * pointSpacing_mm, 0});
  for (const double friction : {0.3, 0.5, 1.}) {
    for (const double aside_mm : {0.03, 0.1, 0.3}) {
      SCOPED_TRACE(testing::Message() << "friction " << friction << ", " << aside_mm << " mm aside");
      Indenter sphere;
      sphere.radius_mm = 4;
      sphere.friction = friction;
      const std::vector<Indenter> indenters{sphere};
      const Eigen::Vector3d tip_mm(pointSpacing_mm * (pointsAside / 2), pointSpacing_mm * (pointsAside / 2),
                                   0); // NOLINT(bugprone-integer-division)
      ReducedContact contact(indenters, points, tip_mm);
      ContactState state = untouched(points.size(), 1);
      const auto places = [&] {
        Eigen::Matrix3Xd x = rest_mm;
        x.reshaped() += compliance * state.forces_N.reshaped();
        return x;
      };
      contact.startStep(places(), state);
      ASSERT_TRUE(contact.solve(compliance, places(), {moved(0, -0.15)}, state, {}));
      const Eigen::Matrix3Xd pressed_mm = places();
      const Eigen::Matrix3Xd before_mm = pressed_mm.colwise() - state.translations_mm.col(0);
      const std::vector<ContactStatus> statusesBefore = state.statuses;
      contact.startStep(pressed_mm, state);
      ASSERT_TRUE(contact.solve(compliance, pressed_mm, {moved(aside_mm, -0.15)}, state, {}));
      const Eigen::Matrix3Xd x = places();
      EXPECT_LT(contact.penetration_mm(x, state), 1e-9);
      int sticking = 0;
      for (Eigen::Index i = 0; i < x.cols(); ++i) {
        const Eigen::Vector3d f = state.forces_N.col(i);
        const Eigen::Vector3d place = x.col(i) - state.translations_mm.col(0);
        const Eigen::Vector3d n = distance(sphere, place - tip_mm).normal;
        const double p = f.dot(n);
        const Eigen::Vector3d along = f - p * n;
        EXPECT_GE(p, -1e-12);
        EXPECT_LE(along.norm(), friction * p * (1 + 1e-6) + 1e-12);
        if (state.statuses[std::size_t(i)] != ContactStatus::Stick ||
            statusesBefore[std::size_t(i)] == ContactStatus::Open)
          continue;
        ++sticking;
        const Eigen::Vector3d slip = place - before_mm.col(i);
        EXPECT_LT((slip - slip.dot(n) * n).norm(), 1e-9);
      }
      EXPECT_GT(state.forces_N.row(0).sum(), 0);
      if (aside_mm < 0.05) {
        EXPECT_GT(sticking, 20);
      }
    }
  }
}

} // namespace palp
