#pragma once

#include "app/gui/project/DesignStudies.h"
#include "app/scenes/block/map/FaceMap.h"
#include "app/scenes/charts/Heatmap.h"
#include "app/study/reports/Report.h"
#include "solver/InfluenceSurfaces.h"
#include "solver/SensorMesh.h"

#include <memory>
#include <stop_token>

namespace palp {

/// What a map is read out of, whatever touch and noise it is for.
struct MapBasis {
  SensorDesign design; ///< with the law that is mapped
  MeshOptions mesh;    ///< with what the touches ask of it
  InfluenceSurfaces surfaces;
};

/// The design with the law that the settings ask for.
SensorDesign mappedDesign(const SensorDesign& design, const MapSettings& settings);

/// The touch that is mapped.
Indenter mappedTouch(const SensorDesign& design, const MapSettings& settings);

/// A map of the design, and what it was read out of; takes over from `before` (null: nothing) what still holds. The
/// basis is null where it was stopped. Throws DesignError where there is no map, and Cancelled.
struct MapFound {
  std::shared_ptr<const MapBasis> basis;
  MappedResolution map;
};
MapFound mapResolution(const SensorDesign& design, const MeshOptions& mesh, const MapSettings& settings, double noise,
                       const std::shared_ptr<const MapBasis>& before, const ReportProgress& progress,
                       const std::stop_token& stop);

/// One quantity of it, places along x x places along y; not a number where there is none.
Eigen::MatrixXd valuesOf(const MappedResolution& map, std::size_t quantity);
/// Over the block, and as a chart of its own with places in mm at its sides.
FaceMap faceMap(const MappedResolution& map, std::size_t quantity);
HeatmapSpec mapHeatmap(const MappedResolution& map, std::size_t quantity);

} // namespace palp
