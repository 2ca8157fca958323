#include "solver/contact/ContactDisc.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

TEST(ContactDisc, SharesOutTheWholeForceAsThePressuresDo) {
  const ContactDisc& disc = contactDisc();
  EXPECT_NEAR(disc.hertz.sum(), 1, 1e-12);
  EXPECT_NEAR(disc.flat.sum(), 1, 1e-12);
  const Eigen::VectorXd square = disc.points.colwise().squaredNorm();
  EXPECT_NEAR(disc.hertz.dot(square), 2. / 5, 1e-12); // mean of r^2 over sqrt(1 - r^2), and over its inverse
  EXPECT_NEAR(disc.flat.dot(square), 2. / 3, 1e-12);
  EXPECT_LT((disc.points * disc.hertz).norm(), 1e-12);
  EXPECT_LT((disc.points * disc.flat).norm(), 1e-12);
}

/// Quadratic between lines 0.4 of the radius apart and with a kink at each, as a mesh makes the answer to a force.
double betweenLines(double x) {
  const double part = x / 0.4 - std::floor(x / 0.4);
  return 4 * part * (1 - part);
}

TEST(ContactDisc, SumsWhatAMeshMakesOfTheSurfaceWhereverTheContactLies) {
  const ContactDisc& disc = contactDisc();
  // The mean under Hertz's pressure by strips across x: 3/4 (1 - x^2) dx, at 200,000 of them.
  constexpr int strips = 200'000;
  double worst = 0;
  for (const double shift : {0., 0.07, 0.13, 0.2, 0.31}) {
    double expected = 0, found = 0;
    for (int i = 0; i < strips; ++i) {
      const double x = 2 * (i + 0.5) / strips - 1;
      expected += 0.75 * (1 - x * x) * betweenLines(x + shift) * 2 / strips;
    }
    for (Eigen::Index k = 0; k < disc.points.cols(); ++k)
      found += disc.hertz(k) * betweenLines(disc.points(0, k) + shift);
    worst = std::max(worst, std::abs(found - expected));
  }
  EXPECT_LT(worst, 0.01); // of the pattern's height
}

} // namespace
} // namespace palp
