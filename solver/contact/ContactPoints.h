#pragma once

#include "model/LoadCase.h"
#include "model/Mesh.h"

#include <vector>

namespace palp {

/// A point where the top face may touch an indenter: a node with its share of the face at rest. On quadratic triangles
/// these are the nodes in the middle of edges, each with a third of its faces' areas; the corners' shares are zero.
struct ContactPoint {
  int node = 0;
  double area_mm2 = 0;
  int indenter = 0; ///< that may touch it
};

/// Ball, pin or cylinder: no flat end.
bool isRound(const Indenter& indenter);

/// All points of the top face, by ascending node.
std::vector<ContactPoint> contactPoints(const Mesh& mesh);

/// Position of the lowest point of an indenter before it moves: on the top face, at its position.
Eigen::Vector3d tipAtRest_mm(const Indenter& indenter, const Mesh& mesh);

/// The same of all indenters, 3 x indenters.
Eigen::Matrix3Xd tipsAtRest_mm(const std::vector<Indenter>& indenters, const Mesh& mesh);

/// The candidate points: those inside an indenter that moves through the undeformed body along its path from load to
/// load, `margin` times as deep as estimated.
std::vector<ContactPoint> touchablePoints(const Mesh& mesh, const SensorDesign& design,
                                          const std::vector<LoadCase>& path, double margin);

} // namespace palp
