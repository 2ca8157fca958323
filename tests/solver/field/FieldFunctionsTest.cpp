#include "solver/field/FieldFunctions.h"

#include "solver/SensorMesh.h"
#include "solver/element/ElementGeometry.h"
#include "tests/model/RandomLayout.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <array>
#include <cmath>
#include <functional>
#include <map>

namespace palp {
namespace {

/// A small random block and a pressure at its nodes.
struct Pressed {
  explicit Pressed(unsigned seed, const std::function<double(const Eigen::Vector3d&)>& pressure)
      : mesh(sensorMesh(randomLayout(seed, 0.8))), functions(mesh, conductivity(pressure), 2) {}

  [[nodiscard]] FieldConductivity conductivity(const std::function<double(const Eigen::Vector3d&)>& pressure) const {
    FieldConductivity k{Eigen::VectorXd(mesh.nodes()), {.p0_MPa = 0.1, .exponent = 1.5}};
    for (int n = 0; n < mesh.nodes(); ++n) k.pressures_MPa(n) = pressure(mesh.tets().nodes_mm.col(n));
    return k;
  }

  FieldMesh mesh;
  FieldFunctions functions;
};

double wave(const Eigen::Vector3d& x) {
  return std::sin(x.x() + 0.7 * x.y() - x.z());
}

/// By their places among all.
std::map<int, double> valuesAt(const FieldFunctions& functions, int element, const Eigen::Vector4d& barycentric) {
  std::map<int, double> values;
  const FieldFunctions::Point there = functions.at(element, barycentric);
  for (int f = 0; f < functions.count(element); ++f) values[functions.row(f, element)] += there.values(f);
  return values;
}

} // namespace

class FieldFunctionsOf : public testing::TestWithParam<unsigned> {};

TEST_P(FieldFunctionsOf, OfCornersAreZeroAtAllNodes) {
  const Pressed pressed(GetParam(), wave);
  int rough = 0;
  for (int e = 0; e < pressed.mesh.elements(); ++e) {
    if (pressed.functions.count(e) == 10) continue;
    ++rough;
    for (int n = 0; n < 10; ++n)
      EXPECT_LT(pressed.functions.at(e, tetNode(n)).values.tail<4>().cwiseAbs().maxCoeff(), 1e-14);
  }
  EXPECT_GT(rough, pressed.mesh.elements() / 4);
  EXPECT_LT(rough, pressed.mesh.elements()); // elsewhere the pressure is below 0
}

TEST_P(FieldFunctionsOf, AreTheSameOnBothSidesOfAFace) {
  const Pressed pressed(GetParam(), wave);
  const Eigen::MatrixXi& elements = pressed.mesh.tets().elements;
  std::map<std::array<int, 3>, std::map<int, double>> seen;
  int shared = 0;
  for (int e = 0; e < pressed.mesh.elements(); ++e)
    for (int opposite = 0; opposite < 4; ++opposite) {
      std::array<int, 3> corners{};
      for (int k = 0, i = 0; k < 4; ++k)
        if (k != opposite) corners[std::size_t(i++)] = elements(k, e);
      std::sort(corners.begin(), corners.end());
      Eigen::Vector4d place = Eigen::Vector4d::Zero(); // the same point of the face from either side
      for (int k = 0; k < 4; ++k)
        for (std::size_t i = 0; i < 3; ++i)
          if (elements(k, e) == corners[i]) place(k) = std::array{0.2, 0.3, 0.5}[i];
      const std::map<int, double> values = valuesAt(pressed.functions, e, place);
      const auto [other, first] = seen.try_emplace(corners, values);
      if (first) continue;
      ++shared;
      std::map<int, double> difference = values;
      for (const auto& [row, value] : other->second) difference[row] -= value;
      for (const auto& [row, value] : difference) EXPECT_LT(std::abs(value), 1e-13) << "function " << row;
    }
  EXPECT_GT(shared, pressed.mesh.elements());
}

TEST_P(FieldFunctionsOf, HaveTheirDerivatives) {
  const Pressed pressed(GetParam(), wave);
  constexpr double step = 1e-6;
  const Eigen::Vector4d place(0.17, 0.23, 0.29, 0.31);
  for (int e = 0; e < pressed.mesh.elements(); e += 7) {
    const FieldFunctions::Point there = pressed.functions.at(e, place);
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::Vector4d way = Eigen::Vector4d::Zero();
      way(axis + 1) = step;
      way(0) = -step;
      const Eigen::Matrix<double, FieldFunctions::most, 1> slope =
          (pressed.functions.at(e, place + way).values - pressed.functions.at(e, place - way).values) / (2 * step);
      EXPECT_LT((slope - there.gradients.col(axis)).cwiseAbs().maxCoeff(), 1e-5) << "element " << e;
    }
  }
}

TEST_P(FieldFunctionsOf, MakeUpWhatAQuadraticFunctionLeavesOfTheInverseRoot) {
  const Pressed pressed(GetParam(), wave);
  const FieldConductivity& k = pressed.functions.conductivity();
  const Eigen::Vector4d place(0.4, 0.3, 0.2, 0.1);
  for (int e = 0; e < pressed.mesh.elements(); ++e) {
    const Eigen::Matrix<double, 10, 1> pressures = k.pressures_MPa(pressed.mesh.tets().elements.col(e));
    const FieldFunctions::Point there = pressed.functions.at(e, place);
    double made = -there.values.tail<4>().sum();
    for (int n = 0; n < 10; ++n) made += there.values(n) * std::exp(-k.halfLogConductivity(pressures(n)));
    int rough = 0;
    for (int corner = 0; corner < 4; ++corner)
      rough += pressed.functions.isRough(pressed.mesh.tets().elements(corner, e)) ? 1 : 0;
    EXPECT_NEAR(made, std::exp(-k.halfLogConductivity(there.values.head<10>().dot(pressures))),
                rough == 4 ? 1e-14 : 2e-3)
        << "element " << e;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, FieldFunctionsOf, testing::Values(1U, 7U));

TEST(FieldFunctions, AreQuadraticAloneWhereTheConductivityIsEven) {
  const Pressed none(1, [](const Eigen::Vector3d&) { return -0.2; });
  const Pressed even(1, [](const Eigen::Vector3d&) { return 0.3; });
  for (int e = 0; e < none.mesh.elements(); ++e) {
    EXPECT_EQ(none.functions.count(e), 10);
    EXPECT_EQ(even.functions.count(e), 10);
  }
}

} // namespace palp
