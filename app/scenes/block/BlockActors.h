#pragma once

#include "app/scenes/ColorScale.h"
#include "app/scenes/block/CutFace.h"
#include "app/scenes/block/DeformationScene.h"
#include "app/scenes/block/MeshSurface.h"
#include "app/scenes/block/Polylines.h"

#include <vtkActor.h>
#include <vtkPlane.h>
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <optional>
#include <vector>

class vtkPolyData;
class vtkPolyDataMapper;

namespace palp {

/// The block itself: coloured surface, mesh edges, its shape at rest and the numbered load areas.
class BlockActors {
public:
  explicit BlockActors(vtkRenderer& renderer);

  void setMesh(const SensorDesign& design, const Mesh& mesh);
  /// Displacements already multiplied by the deformation scale; `values` at the mesh's nodes, empty at rest.
  void show(const Mesh& mesh, const Eigen::Matrix3Xd& drawnDisplacement_mm, const std::vector<double>& values,
            const ColorScale& colors, const DeformationOptions& options);

  /// Outlines of loaded discs on the top face, as the block is drawn.
  void showDiscs(const std::vector<PatchLoad>& discs, const DeformationOptions& options);
  /// Where a point of the top face is drawn.
  [[nodiscard]] Eigen::Vector3d drawnPlace_mm(const Eigen::Vector2d& top_mm) const;
  /// Where the material that is drawn at a point of a triangle of the surface lies at rest.
  [[nodiscard]] Eigen::Vector3d restPlace_mm(vtkIdType triangle, const Eigen::Vector3d& drawn_mm) const;

  /// Mesh node whose drawn place is nearest; -1 without a mesh.
  [[nodiscard]] int nearestNode(const Eigen::Vector3d& drawn_mm) const;
  [[nodiscard]] Eigen::Vector3d drawnPlace_mm(int node) const;
  /// Of all the mesh's nodes.
  [[nodiscard]] const Eigen::Matrix3Xd& drawn_mm() const { return drawn_mm_; }

  struct AreaLabel {
    int area = 0;
    Eigen::Vector3d place_mm = Eigen::Vector3d::Zero();
  };
  /// Where the numbers of the load areas are written; none where the block is cut away.
  [[nodiscard]] std::vector<AreaLabel> areaLabels() const;

private:
  vtkSmartPointer<vtkPolyData> surfaceData_;
  vtkSmartPointer<vtkPolyDataMapper> surfaceMapper_;
  vtkSmartPointer<vtkActor> surfaceActor_;
  vtkSmartPointer<vtkPlane> plane_;
  CutFace cut_;
  Polylines edges_;
  Polylines ghost_;
  Polylines borders_;
  Polylines selected_;
  Polylines discs_;
  MeshSurface surface_;
  std::optional<TopFace> top_;
  std::vector<std::vector<TopPoint>> areaBorders_;
  std::vector<TopPoint> areaLabels_;
  Eigen::Matrix3Xd rest_mm_;         ///< of the mesh's nodes
  Eigen::Matrix3Xd drawn_mm_;        ///< places of the mesh's nodes
  std::optional<CutPlane> cutPlane_; ///< as drawn
};

} // namespace palp
