#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QString>

namespace palp {

/// What samples there are, where from, and which forces, places and resistances they span.
QString samplesWords(const NetworkSession& session);

/// What a press of the button will make.
QString plannedWords(const SampleSettings& samples, const SensorDesign& design, const MeshOptions& mesh);

} // namespace palp
