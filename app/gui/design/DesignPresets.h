#pragma once

#include "model/SensorDesign.h"

#include <QString>

#include <vector>

namespace palp {

/// A design to start from.
struct DesignPreset {
  QString name;
  QString tip;
  SensorDesign design;
};

/// The paper's first; the others differ from it in what their names say.
std::vector<DesignPreset> designPresets();

} // namespace palp
