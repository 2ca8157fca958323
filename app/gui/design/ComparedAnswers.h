#pragma once

#include "app/gui/project/DesignStudies.h"
#include "app/study/reports/Report.h"
#include "solver/SensorMesh.h"

#include <stop_token>

namespace palp {

/// Solves both designs of `compared` under its load, the earlier one at the same shares of its block, and bounds the
/// errors of both: fills in all but the designs, their name, the load and the noise. False where it was stopped.
bool compareDesigns(DesignsCompared& compared, const MeshOptions& mesh, const ReportProgress& progress,
                    const std::stop_token& stop);

} // namespace palp
