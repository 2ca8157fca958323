#pragma once

#include "model/Indenter.h"
#include "model/SensorDesign.h"

#include <QWidget>

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;

namespace palp {

/// Shape, size, place, friction and motion of one indenter; of one under force control, the force is elsewhere.
class IndenterPanel : public QWidget {
  Q_OBJECT

public:
  explicit IndenterPanel(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const Indenter& indenter, const SensorDesign& design);

signals:
  /// By the user's hand only.
  void edited(const palp::Indenter& indenter);

private:
  QDoubleSpinBox* addNumber(QFormLayout& form, const char* name, const QString& label, const QString& unit,
                            const QString& tip);
  void read();
  void drawShapes();
  void changeEvent(QEvent* event) override;

  Indenter shown_;
  bool displaying_ = false;
  QComboBox* shape_ = nullptr;
  QComboBox* control_ = nullptr;
  QDoubleSpinBox* radius_ = nullptr;
  QDoubleSpinBox* rim_ = nullptr;
  QDoubleSpinBox* x_ = nullptr;
  QDoubleSpinBox* y_ = nullptr;
  QDoubleSpinBox* friction_ = nullptr;
  QDoubleSpinBox* depth_ = nullptr;
  QDoubleSpinBox* shiftX_ = nullptr;
  QDoubleSpinBox* shiftY_ = nullptr;
};

} // namespace palp
