#include "solver/field/SphericalMeans.h"

#include "solver/element/ElementGeometry.h"

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace palp {

namespace {

struct SphereRule {
  static constexpr int points = 50;
  Eigen::Matrix<double, 3, points> directions;
  Eigen::Matrix<double, points, 1> weights; ///< sum 1

  SphereRule() {
    Eigen::Index i = 0;
    const auto add = [&](const Eigen::Vector3d& of, double weight) { // all signs
      for (int signs = 0; signs < 8; ++signs) {
        const Eigen::Vector3d sign((signs & 1) != 0 ? -1 : 1, (signs & 2) != 0 ? -1 : 1, (signs & 4) != 0 ? -1 : 1);
        if ((sign.array() < 0 && of.array() == 0).any()) continue;
        directions.col(i) = of.cwiseProduct(sign).normalized();
        weights(i++) = weight;
      }
    };
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d one = Eigen::Vector3d::Unit(axis), others = Eigen::Vector3d::Ones() - one;
      add(one, 4. / 315);
      add(others, 64. / 2835);
      add(others + 3 * one, 14641. / 725760);
    }
    add(Eigen::Vector3d::Ones(), 27. / 1280);
  }
};

/// Gauss and Legendre's points on (0, 1).
constexpr std::array<std::pair<double, double>, 8> kRadii{{{0.019855071751232, 0.050614268145188},
                                                           {0.101666761293187, 0.111190517226687},
                                                           {0.237233795041836, 0.156853322938944},
                                                           {0.408282678752175, 0.181341891689181},
                                                           {0.591717321247825, 0.181341891689181},
                                                           {0.762766204958164, 0.156853322938944},
                                                           {0.898333238706813, 0.111190517226687},
                                                           {0.980144928248768, 0.050614268145188}}};

const SphereRule& sphereRule() {
  static const SphereRule rule;
  return rule;
}

} // namespace

/// Through the face that the point lies behind most, until it is behind none or the block ends.
SphericalMeans::Place SphericalMeans::find(const Eigen::Vector3d& atRest_mm, int from) const {
  constexpr int mostSteps = 100;
  constexpr double outside = -1e-9;
  Place place{from, {}};
  for (int step = 0; step < mostSteps; ++step) {
    const Mesh& tets = mesh_->tets();
    const TetGeometry geometry = tetGeometry(tets, place.element);
    place.barycentric =
        geometry.gradients.transpose() * (atRest_mm - tets.nodes_mm.col(tets.elements(0, place.element)));
    place.barycentric(0) += 1;
    Eigen::Index behind = 0;
    if (place.barycentric.minCoeff(&behind) > outside) break;
    const int next = mesh_->neighbours()(behind, place.element);
    if (next < 0) break;
    place.element = next;
  }
  return place;
}

AtElectrode SphericalMeans::around(const Eigen::Matrix3Xd& nodes_mm, const FieldFunctions& functions,
                                   const Electrode& electrode) const {
  const Mesh& tets = mesh_->tets();
  const FieldConductivity& conductivity = functions.conductivity();
  const SphereRule& rule = sphereRule();
  const auto own = tets.elements.col(electrode.element);
  AtElectrode result;
  result.element = electrode.element;
  result.there = functions.at(electrode.element, electrode.barycentric);
  const Eigen::Vector3d atRest = tets.nodes_mm(Eigen::all, own) * result.there.values.head<10>();
  const Eigen::Matrix3d gradient =
      nodes_mm(Eigen::all, own) *
      tetShapeGradients(tetGeometry(tets, electrode.element), electrode.barycentric).transpose();
  const Eigen::Matrix3d back = gradient.inverse();
  std::array<int, SphereRule::points> last; // the element of the direction's point before
  last.fill(electrode.element);
  // l at the sphere's points, in the direction's order. The place at rest is corrected once, as the block is bent.
  const auto onSphere = [&](double r) {
    Eigen::Matrix<double, SphereRule::points, 1> values;
    for (Eigen::Index i = 0; i < SphereRule::points; ++i) {
      const Eigen::Vector3d from = r * rule.directions.col(i);
      Eigen::Vector3d there = atRest + back * from;
      int& element = last[std::size_t(i)];
      Place place = find(there, element);
      const auto shapesAt = [&] { return tetShapes(place.barycentric); };
      there += back * (electrode.point_mm + from - nodes_mm(Eigen::all, tets.elements.col(place.element)) * shapesAt());
      place = find(there, place.element);
      element = place.element;
      values(i) =
          conductivity.halfLogConductivity(shapesAt().dot(conductivity.pressures_MPa(tets.elements.col(element))));
    }
    return values;
  };
  const double a = electrode.radius_mm, span = std::log(electrode.cutoff_mm / a);
  const Eigen::Matrix<double, SphereRule::points, 1> surface = onSphere(a).cwiseProduct(rule.weights);
  result.value = surface.sum();
  result.slope = 3 / a * (rule.directions * surface);
  if (!(span > 0)) return result;
  for (const auto& [share, weight] : kRadii) { // over ln r
    const double r = a * std::exp(span * share), more = onSphere(r).dot(rule.weights) - result.value;
    const double square = std::pow(r / electrode.cutoff_mm, 2), fall = 4 * square * (1 - square); // - r chi'
    result.simple -= weight * span * more * fall;
    result.square -= weight * span * more * (AtElectrode::cutOff(square) + fall) / (2 * std::numbers::pi * r);
  }
  return result;
}

} // namespace palp
