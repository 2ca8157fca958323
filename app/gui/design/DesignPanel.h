#pragma once

#include "model/SensorDesign.h"

#include <QWidget>

#include <vector>

class QCheckBox;
class QLabel;
class QLineEdit;

namespace palp {

/// Every parameter of the design with its unit, checked while typing; what is wrong is said under the field.
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
    QLabel* problem = nullptr;
  };
  void buildPresets();
  void buildFields();
  void buildSwitches();
  void read(const QString& what);
  void showDerived(const SensorDesign& design);

  SensorDesign design_;
  bool displaying_ = false;
  std::vector<Row> rows_;
  QCheckBox* follows_ = nullptr;
  QCheckBox* law_ = nullptr;
  QLineEdit* p0_ = nullptr;
  QLineEdit* exponent_ = nullptr;
  QLabel* lawProblem_ = nullptr;
  QLabel* derived_ = nullptr;
};

} // namespace palp
