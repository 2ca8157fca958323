#include "model/base/GaussLegendre.h"

#include <cmath>
#include <numbers>

namespace palp {

QuadratureRule gaussLegendre(int count) {
  QuadratureRule rule{Eigen::ArrayXd(count), Eigen::ArrayXd(count)};
  for (int i = 0; i < count; ++i) {
    double x = -std::cos(std::numbers::pi * (i + 0.75) / (count + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 10; ++iteration) { // Newton, quadratic from a start good to some digits
      double before = 1, value = x;
      for (int n = 2; n <= count; ++n) {
        const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
      }
      slope = count * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    rule.points(i) = x;
    rule.weights(i) = 2 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

QuadratureRule gaussOnPanels(const Eigen::Ref<const Eigen::ArrayXd>& edges, int pointsAPanel) {
  const QuadratureRule one = gaussLegendre(pointsAPanel);
  const Eigen::Index panels = edges.size() - 1;
  QuadratureRule all{Eigen::ArrayXd(panels * pointsAPanel), Eigen::ArrayXd(panels * pointsAPanel)};
  for (Eigen::Index i = 0; i < panels; ++i) {
    const double half = (edges(i + 1) - edges(i)) / 2;
    all.points.segment(i * pointsAPanel, pointsAPanel) = half * one.points + (edges(i) + edges(i + 1)) / 2;
    all.weights.segment(i * pointsAPanel, pointsAPanel) = half * one.weights;
  }
  return all;
}

} // namespace palp
