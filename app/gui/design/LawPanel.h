#pragma once

#include "app/gui/design/DesignRows.h"

#include <QGroupBox>

#include <optional>

class QCheckBox;

namespace palp {

/// The law of the resistances with its numbers, and the pressure law, which holds under either. The numbers of the law
/// that is not chosen wait in their hidden rows.
class LawPanel : public QGroupBox {
  Q_OBJECT

public:
  explicit LawPanel(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const SensorDesign& design);
  /// Sets what is written into the design; false where something is not a value.
  bool read(SensorDesign& design);
  /// Shows what was wrong at read() and these faults where they belong; in use is the last argument's law.
  void say(const std::vector<DesignFault>& faults, const SensorDesign& inUse, bool applied);

signals:
  /// By the user's hand only.
  void edited(const QString& what);

private:
  void buildPressureLaw(QFormLayout& form);
  /// Shows the rows of the selected law, and what its read-out and its radius mean.
  void follow(const SensorDesign& design);
  void warn(const SensorDesign& design);

  bool displaying_ = false;
  DesignRows rows_;
  WrappedLabel* readoutWords_ = nullptr;
  WrappedLabel* warning_ = nullptr;
  std::optional<SensorDesign> warnedOf_;
  QString warned_; ///< of that design
  QCheckBox* pressureLaw_ = nullptr;
  QLineEdit* p0_ = nullptr;
  QLineEdit* exponent_ = nullptr;
  WrappedLabel* pressureProblem_ = nullptr;
  QString pressureWrong_; ///< at the last read()
};

} // namespace palp
