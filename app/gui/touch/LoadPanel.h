#pragma once

#include "model/LoadCase.h"
#include "model/SensorDesign.h"

#include <QWidget>

#include <array>
#include <vector>

class QDoubleSpinBox;
class QGridLayout;
class QLabel;
class QPushButton;
class QSlider;

namespace palp {

/// The forces on the load areas: areas are chosen on a plan of the top face, the force of one by numbers or sliders.
class LoadPanel : public QWidget {
  Q_OBJECT

public:
  explicit LoadPanel(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const SensorDesign& design, const LoadCase& load);
  /// Chooses an area as a click on its button does.
  void chooseArea(int area);
  [[nodiscard]] int area() const { return area_; }

signals:
  /// By the user's hand only.
  void edited(const palp::LoadCase& load);
  void areaChosen(int area);

private:
  void buildPlan();
  void buildForces();
  void showForce();
  void setForce(int direction, double value_N);
  void toggleArea(int area, bool loaded);
  AreaLoad* loadOf(int area);

  SensorDesign design_;
  LoadCase load_;
  int area_ = 0;
  QGridLayout* plan_ = nullptr;
  std::vector<QPushButton*> buttons_;
  QLabel* title_ = nullptr;
  QPushButton* clear_ = nullptr;
  std::array<QDoubleSpinBox*, 3> spins_{};
  std::array<QSlider*, 3> sliders_{};
};

} // namespace palp
