#pragma once

#include "model/SensorDesign.h"

#include <QWidget>

#include <optional>
#include <vector>

class QCheckBox;
class QFormLayout;
class QLabel;
class QLineEdit;

namespace palp {

class WrappedLabel;

/// Every parameter of the design with its unit, checked while typing; what is wrong or not in use is said under the
/// field itself.
class DesignPanel : public QWidget {
  Q_OBJECT

public:
  explicit DesignPanel(QWidget* parent = nullptr);

  /// Emits nothing; fields that say the same already are left as they are written.
  void display(const SensorDesign& design);

signals:
  /// By the user's hand only, and only designs that can be built.
  void edited(const QString& what, const palp::SensorDesign& design);

private:
  struct Row {
    QLineEdit* edit = nullptr;
    WrappedLabel* problem = nullptr;
  };
  void buildPresets();
  void buildFields();
  void buildSwitches();
  void addWireScaling(QFormLayout& form);
  void read(const QString& what);
  /// Another size of the block, with its wires in the same shares of it where that is wanted.
  void readSize(const QString& what);
  void sayUnderFields(const std::vector<QString>& sentences, bool applied);
  void showDerived(const SensorDesign& design);

  SensorDesign design_;
  std::optional<SensorDesign> scaledFrom_; ///< as the wires lay before the size that is typed now
  bool displaying_ = false;
  std::vector<Row> rows_;
  QCheckBox* scaleWires_ = nullptr;
  QCheckBox* follows_ = nullptr;
  QCheckBox* law_ = nullptr;
  QLineEdit* p0_ = nullptr;
  QLineEdit* exponent_ = nullptr;
  WrappedLabel* lawProblem_ = nullptr;
  WrappedLabel* derived_ = nullptr;
};

} // namespace palp
