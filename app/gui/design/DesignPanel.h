#pragma once

#include "app/gui/design/DesignRows.h"

#include <QWidget>

#include <optional>

class QCheckBox;

namespace palp {

class LawPanel;

/// Every parameter of the design with its unit, checked while typing; what is wrong or not in use is shown under the
/// field itself.
class DesignPanel : public QWidget {
  Q_OBJECT

public:
  explicit DesignPanel(QWidget* parent = nullptr);

  /// Emits nothing; fields that say the same already are left as they are written.
  void display(const SensorDesign& design);
  /// Whether the wires scale with the block; emits nothing.
  void displayScaling(bool on);

signals:
  /// By the user's hand only, and only designs that can be built.
  void edited(const QString& what, const palp::SensorDesign& design);
  void scalingChosen(bool on);

private:
  void buildPresets();
  void buildFields();
  void addWireScaling(QFormLayout& form);
  void addFollowing(QFormLayout& form);
  void read(const QString& what);
  /// Another size of the block, with its wires in the same shares of it where that is wanted.
  void readSize(const QString& what);
  void readRubberLaw(const QString& what);
  void say(const std::vector<DesignFault>& faults, bool applied);
  void showDerived(const SensorDesign& design);

  SensorDesign design_;
  std::optional<SensorDesign> scaledFrom_; ///< as the wires lay before the size that is typed now
  bool displaying_ = false;
  DesignRows rows_;
  LawPanel* law_ = nullptr;
  QCheckBox* scaleWires_ = nullptr;
  QCheckBox* follows_ = nullptr;
  WrappedLabel* derived_ = nullptr;
};

} // namespace palp
