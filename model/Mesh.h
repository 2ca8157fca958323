#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace palp {

/// Shape of an element; node orders are VTK's (vtkQuadraticTetra, vtkHexahedron).
enum class ElementShape { Tetrahedron10, Hexahedron8 };

/// Volume mesh of the block at rest.
struct Mesh {
  ElementShape shape = ElementShape::Tetrahedron10;
  Eigen::Matrix3Xd nodes_mm;    ///< 3 x nodes; for Tetrahedron10 the corners come first, then the edge midpoints
  Eigen::MatrixXi elements;     ///< nodes of an element x elements
  Eigen::MatrixXi topFaces;     ///< nodes of a face (6 or 4) x faces of the top face, ordered as VTK's faces
  Eigen::VectorXi topFaceAreas; ///< load area of each top face
  std::vector<int> upperElectrodeNodes; ///< node of each upper electrode; empty if they are not nodes
  double size_mm = 0;                   ///< bulk element size a graded mesh was made with; 0: not a graded mesh

  [[nodiscard]] int nodeCount() const { return static_cast<int>(nodes_mm.cols()); }
  [[nodiscard]] int elementCount() const { return static_cast<int>(elements.cols()); }
};

/// Whether each node is on the clamped bottom face z = 0, to rounding.
std::vector<bool> clampedNodes(const Mesh& mesh);

/// Displacement unknowns: three per node that is not clamped.
int freeUnknowns(const Mesh& mesh);

/// "10-node tetrahedra" or "8-node hexahedra".
std::string shapeName(ElementShape shape);

} // namespace palp
