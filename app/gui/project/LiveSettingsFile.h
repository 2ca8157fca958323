#pragma once

// What a project file keeps of the Live scene.

#include "app/gui/project/Project.h"
#include "io/StrictJson.h"

#include <QJsonObject>

namespace palp {

QJsonObject liveJson(const LiveSettings& live);
LiveSettings liveOf(const JsonPlace& place);

/// Of the boards beside the first.
QJsonArray boardsJson(const std::vector<LiveSettings>& boards);
std::vector<LiveSettings> boardsOf(const JsonPlace& place);

} // namespace palp
