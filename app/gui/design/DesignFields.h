#pragma once

#include "model/SensorDesign.h"

#include <QString>

#include <functional>
#include <vector>

namespace palp {

/// A value of a parameter that has few of them.
struct DesignChoice {
  QString words;
  QString tip;
};

/// One parameter of a design as text to edit: its key in the design file, what it is called, its unit.
struct DesignField {
  QString key;
  QString group;
  QString label;
  QString unit;
  QString tip;
  std::function<QString(SensorDesign)> text; ///< of a copy; empty where the design has no such parameter
  /// Sets the parameter where the design has it; a sentence where the text is none of its values.
  std::function<QString(SensorDesign&, const QString&)> set;
  std::vector<DesignChoice> choices = {};               ///< none: it is typed
  std::function<bool(const SensorDesign&)> onlyOf = {}; ///< the designs that have it; empty: all

  [[nodiscard]] bool has(const SensorDesign& design) const { return !onlyOf || onlyOf(design); }
};

/// All that can be edited, in the order of the design file.
const std::vector<DesignField>& designFields();

/// The group of the resistance law's fields.
QString resistanceGroup();

/// The field with a key, which must be one of designFields().
const DesignField& designField(const QString& key);

} // namespace palp
