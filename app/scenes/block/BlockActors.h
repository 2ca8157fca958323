#pragma once

#include "app/scenes/ColorScale.h"
#include "app/scenes/block/CutFace.h"
#include "app/scenes/block/DeformationScene.h"
#include "app/scenes/block/MeshSurface.h"
#include "app/scenes/block/Polylines.h"

#include <vtkActor.h>
#include <vtkPlane.h>
#include <vtkSmartPointer.h>

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
  /// Displacements already multiplied by the warp factor; `values` at the mesh's nodes, empty at rest.
  void show(const Mesh& mesh, const Eigen::Matrix3Xd& drawnDisplacement_mm, const std::vector<double>& values,
            const ColorScale& colors, const DeformationOptions& options);

  /// Mesh node whose drawn place is nearest; -1 without a mesh.
  [[nodiscard]] int nearestNode(const Eigen::Vector3d& drawn_mm) const;
  [[nodiscard]] Eigen::Vector3d drawnPlace_mm(int node) const;

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
  MeshSurface surface_;
  std::vector<std::vector<TopPoint>> areaBorders_;
  std::vector<TopPoint> areaLabels_;
  Eigen::Matrix3Xd drawn_mm_;      ///< places of the mesh's nodes
  std::optional<double> clipY_mm_; ///< as drawn
};

} // namespace palp
