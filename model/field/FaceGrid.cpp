#include "model/field/FaceGrid.h"

#include "model/FieldAtRest.h"
#include "model/base/GaussLegendre.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kPointsAPanel = 4;
constexpr double kWidth = 0.8;  ///< of a panel, over the depth of the electrode behind it
constexpr double kGrowth = 0.5; ///< of a panel's width with the distance from an electrode

/// Projections of the electrodes onto a face: their depth below it, and their position along one axis of it.
struct Projections {
  Eigen::ArrayXd along_mm;
  Eigen::ArrayXd depth_mm;
};

/// Edges of panels on [low, high], each as wide as the projections near it allow.
void addPanels(std::vector<double>& edges, double low, double high, const Projections& projections, double fineness) {
  constexpr int kSteps = 400;
  std::vector<double> panels{0}; // their number up to each step
  const double step = (high - low) / kSteps;
  for (int i = 0; i < kSteps; ++i) {
    const double s = low + (i + 0.5) * step;
    const double width =
        (kWidth * projections.depth_mm + kGrowth * (projections.along_mm - s).abs()).minCoeff() / fineness;
    panels.push_back(panels.back() + step / width);
  }
  const int count = std::max(1, static_cast<int>(std::ceil(panels.back())));
  for (int i = 1; i < count; ++i) {
    const double wanted = panels.back() * i / count;
    const auto next = std::upper_bound(panels.begin(), panels.end(), wanted);
    const double part = (wanted - *(next - 1)) / (*next - *(next - 1));
    edges.push_back(low + step * (static_cast<double>(next - panels.begin()) - 1 + part));
  }
  edges.push_back(high);
}

QuadratureRule rule(double length, int parts, const Projections& projections, double fineness) {
  std::vector<double> edges{0};
  for (int i = 0; i < parts; ++i) addPanels(edges, length * i / parts, length * (i + 1) / parts, projections, fineness);
  return gaussOnPanels(Eigen::Map<const Eigen::ArrayXd>(edges.data(), static_cast<Eigen::Index>(edges.size())),
                       kPointsAPanel);
}

} // namespace

Eigen::Matrix3Xd FaceGrid::points_mm() const {
  Eigen::Matrix3Xd points(3, count());
  for (Eigen::Index j = 0; j < v_mm.size(); ++j)
    for (Eigen::Index i = 0; i < u_mm.size(); ++i) {
      points(axis, i + u_mm.size() * j) = at_mm;
      points(first, i + u_mm.size() * j) = u_mm(i);
      points(second, i + u_mm.size() * j) = v_mm(j);
    }
  return points;
}

std::vector<FaceGrid> movingFaces(const SensorDesign& design, double fineness) {
  const Eigen::Matrix3Xd electrodes = electrodes_mm(design);
  const int parts[3] = {design.areas.columns, design.areas.rows, 1};
  std::vector<FaceGrid> faces;
  for (const auto& [axis, high] : {std::pair{2, true}, {0, false}, {0, true}, {1, false}, {1, true}}) {
    FaceGrid face;
    face.axis = axis;
    face.high = high;
    face.at_mm = high ? design.block_mm(axis) : 0;
    face.first = axis == 0 ? 1 : 0;
    face.second = axis == 2 ? 1 : 2;
    Projections projections{{}, (electrodes.row(axis).array() - face.at_mm).abs()};
    face.nearest_mm = projections.depth_mm.minCoeff();
    for (const int along : {face.first, face.second}) {
      projections.along_mm = electrodes.row(along);
      QuadratureRule made = rule(design.block_mm(along), parts[along], projections, fineness);
      (along == face.first ? face.u_mm : face.v_mm) = std::move(made.points);
      (along == face.first ? face.uWeights : face.vWeights) = std::move(made.weights);
    }
    faces.push_back(std::move(face));
  }
  return faces;
}

} // namespace palp
