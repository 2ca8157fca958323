#pragma once

// What a project file keeps of the samples that the Network scene makes.

#include "app/gui/project/SampleSettings.h"
#include "io/StrictJson.h"

#include <QJsonObject>

namespace palp {

QJsonObject samplesJson(const SampleSettings& samples);
SampleSettings samplesOf(const JsonPlace& place);

} // namespace palp
