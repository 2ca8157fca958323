#pragma once

#include "app/gui/project/LiveSettings.h"
#include "io/StrictJson.h"

#include <QJsonObject>

namespace palp {

/// Frames and calibrated network of a board, as a project keeps them; empty where there is neither.
QJsonObject calibrationJson(const LiveSettings& live);
/// Reads them into `live`. Throws Error.
void readCalibration(const JsonPlace& place, LiveSettings& live);

} // namespace palp
