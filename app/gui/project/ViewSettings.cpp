#include "app/gui/project/ViewSettings.h"

namespace palp {

std::array<std::array<double, 3>, 2> ViewSettings::lineIn(const Eigen::Vector3d& block_mm) const {
  static const ViewSettings kUnchosen;
  if (lineFrom_mm != kUnchosen.lineFrom_mm || lineTo_mm != kUnchosen.lineTo_mm) return {lineFrom_mm, lineTo_mm};
  const double y = 0.5 * block_mm.y(), z = block_mm.z();
  return {{{0, y, z}, {block_mm.x(), y, z}}};
}

DeformationOptions ViewSettings::blockOptions() const {
  DeformationOptions options;
  options.quantity = quantity;
  options.deformationScale = deformationScale;
  options.cut = cut;
  options.colorMap = colorMap;
  options.fixedRange = shownRange();
  options.extremes = extremes;
  options.undeformedGhost = ghost;
  options.electrodes = electrodes;
  options.forceArrows = arrows;
  options.areaOutlines = outlines;
  options.meshEdges = edges;
  options.litCell = litCell;
  options.lessReference = lessReference;
  options.lessUniform = uniform;
  return options;
}

} // namespace palp
