#pragma once

#include "model/SensorDesign.h"

#include <QString>

#include <functional>
#include <vector>

namespace palp {

/// One parameter of a design as text to edit: its key in the design file, what it is called, its unit.
struct DesignField {
  QString key;
  QString group;
  QString label;
  QString unit;
  QString tip;
  std::function<QString(SensorDesign)> text; ///< of a copy
  /// Sets the parameter; a sentence where the text is none of its values.
  std::function<QString(SensorDesign&, const QString&)> set;
};

/// All that can be edited, in the order of the design file.
const std::vector<DesignField>& designFields();

} // namespace palp
