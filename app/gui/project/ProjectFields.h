#pragma once

// The fields of a project file (resources/docs/formats.md), each described once for both directions. For sources only.

#include "app/gui/project/JsonFields.h"
#include "app/gui/project/Project.h"

namespace palp {

void describe(JsonFields& fields, LoadCase& load);
void describe(JsonFields& fields, IndenterPath& path);
void describe(JsonFields& fields, SampleSettings& samples);
void describe(JsonFields& fields, NetworkSettings& network);
void describe(JsonFields& fields, ViewSettings& view);
void describe(JsonFields& fields, LiveSettings& live);
void describe(JsonFields& fields, DesignStudies& studies);

} // namespace palp
