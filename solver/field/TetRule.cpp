#include "solver/field/TetRule.h"

#include "solver/element/ElementGeometry.h"

#include <utility>

namespace palp {

/// N. J. Walkington, Quadrature on simplices of arbitrary dimension, 2000: 14 points, exact to degree 5.
TetRule::TetRule() {
  std::array<Eigen::Vector4d, points> at;
  std::size_t i = 0;
  for (const auto& [a, w] :
       {std::pair{0.3108859192633006, 0.1126879257180159}, std::pair{0.0927352503108912, 0.0734930431163619}})
    for (int k = 0; k < 4; ++k, ++i) {
      at[i].setConstant(a);
      at[i](k) = 1 - 3 * a;
      weights[i] = w;
    }
  constexpr double a = 0.0455037041256497;
  for (int k = 0; k < 4; ++k)
    for (int l = k + 1; l < 4; ++l, ++i) {
      at[i].setConstant(0.5 - a);
      at[i](k) = at[i](l) = a;
      weights[i] = 0.0425460207770815;
    }
  TetGeometry unit; // gradients of the barycentric coordinates by the last three of them
  unit.gradients << -1, 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1;
  for (i = 0; i < points; ++i) {
    shapes.col(static_cast<Eigen::Index>(i)) = tetShapes(at[i]);
    gradients[i] = tetShapeGradients(unit, at[i]).transpose();
  }
}

const TetRule& tetRule() {
  static const TetRule rule;
  return rule;
}

} // namespace palp
