#include "app/scenes/block/BlockActors.h"

#include "solver/mesh/MappedHexes.h"

#include <gtest/gtest.h>

#include <vtkNew.h>
#include <vtkRenderer.h>

namespace palp {
namespace {

/// The areas whose numbers are written; the paper's block is 30 mm deep, areas 0 to 2 lie in front of y = 15 mm.
std::vector<int> numberedAreas(std::optional<double> clipY_mm, double moved_mm = 0) {
  const Mesh mesh = mappedMesh(paperDesign(), {3, 2, 1});
  const vtkNew<vtkRenderer> renderer;
  BlockActors block(*renderer);
  block.setMesh(paperDesign(), mesh);
  DeformationOptions options;
  if (clipY_mm) options.cut = CutPlane{1, *clipY_mm};
  const Eigen::Vector3d displacement(0, moved_mm, 0);
  block.show(mesh, displacement.replicate(1, mesh.nodeCount()), {}, {}, options);
  std::vector<int> areas;
  for (const BlockActors::AreaLabel& label : block.areaLabels()) areas.push_back(label.area);
  return areas;
}

TEST(BlockActors, NumberEachLoadAreaOfAWholeBlock) {
  EXPECT_EQ(numberedAreas({}), (std::vector{0, 1, 2, 3, 4, 5}));
}

TEST(BlockActors, WriteNoNumberWhereTheBlockIsCutAway) {
  EXPECT_EQ(numberedAreas(10), (std::vector{3, 4, 5}));
  EXPECT_EQ(numberedAreas(29), std::vector<int>{});
}

TEST(BlockActors, CutTheBlockAsItIsDrawn) {
  EXPECT_EQ(numberedAreas(10, 12), (std::vector{0, 1, 2, 3, 4, 5})); // numbers stand at y = 3 and 18 mm at rest
}

} // namespace
} // namespace palp
