#pragma once

#include "app/gui/project/DesignStudies.h"
#include "app/gui/project/IndenterPath.h"

#include <QJsonObject>

namespace palp {

class JsonPlace;

/// As a project file holds them; nothing where all is as by default.
QJsonObject studiesJson(const DesignStudies& studies);
/// Throws Error.
DesignStudies studiesOf(const JsonPlace& place);

/// As in the project file.
QJsonObject pathJson(const IndenterPath& path);
/// Throws Error.
IndenterPath pathOf(const JsonPlace& place);

/// As in the project file.
QJsonObject loadJson(const LoadCase& load);
/// Throws Error.
LoadCase loadOf(const JsonPlace& place);

} // namespace palp
