#pragma once

#include "app/gui/project/LiveSettings.h"
#include "app/gui/widgets/FieldBindings.h"

#include <QWidget>

#include <array>

class QFormLayout;
class QHBoxLayout;
class QLabel;
class QPushButton;

namespace palp {

/// What the panel shows of the simulated board.
struct SimulationState {
  bool pluggedIn = true;
  bool ownDesign = true; ///< it simulates the project's design, and an indenter that moves where that is wanted
  int areas = 0;         ///< of the design that it simulates
  int rowWires = 0, columnWires = 0;
  bool solving = false; ///< its samples are being solved
};

/// The simulated board: what it adds to its readings, what is broken, whose design it is, and the touch on it.
class SimulationPanel : public QWidget {
  Q_OBJECT

public:
  explicit SimulationPanel(QWidget* parent = nullptr);

  void display(const LiveSettings& settings);
  void displayState(const SimulationState& state);

signals:
  void edited(const QString& what, const LiveSettings& settings);
  void plugRequested(bool in);
  /// The project's design, or an indenter that moves over it, is to be simulated.
  void designRequested();

private:
  void buildDesign(QFormLayout& form);
  void buildTouch(QFormLayout& form);
  void buildDisturbances(QFormLayout& form);
  void buildFaults(QFormLayout& form);
  QSpinBox* addWire(const QString& name, const QString& what, int SimulationSettings::*wire, const QString& tip);

  FieldBindings<LiveSettings> fields_;
  QLabel* design_ = nullptr;
  QPushButton* simulate_ = nullptr;
  QPushButton* plug_ = nullptr;
  std::array<QDoubleSpinBox*, 2> place_{};
  QFormLayout* form_ = nullptr;
  QHBoxLayout* places_ = nullptr; ///< of the indenter, in the form
  QSpinBox* area_ = nullptr;
  std::array<QDoubleSpinBox*, 3> force_{};
  QSpinBox* openRow_ = nullptr;
  QSpinBox* openColumn_ = nullptr;
};

} // namespace palp
