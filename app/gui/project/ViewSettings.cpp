#include "app/gui/project/ViewSettings.h"

namespace palp {

DeformationOptions ViewSettings::blockOptions() const {
  DeformationOptions options;
  options.quantity = quantity;
  options.warpFactor = warpFactor;
  options.cut = cut;
  options.colorMap = colorMap;
  options.fixedRange = colorRange;
  options.extremes = extremes;
  options.undeformedGhost = ghost;
  options.electrodes = electrodes;
  options.forceArrows = arrows;
  options.areaOutlines = outlines;
  options.meshEdges = edges;
  options.litCell = litCell;
  options.lessKept = lessKept;
  return options;
}

} // namespace palp
