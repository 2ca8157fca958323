#pragma once

#include "app/gui/project/LiveSettings.h"
#include "app/study/live/LiveSession.h"
#include "io/board/HidBoards.h"

#include <QWidget>

#include <functional>

class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QGroupBox;
class QLabel;
class QListWidget;
class QPushButton;
class QSpinBox;

namespace palp {

/// What the panel shows of the running session.
struct LiveSourceState {
  LiveStatus status;
  std::vector<HidBoard> boards;
  bool simulated = false; ///< the virtual board is what streams
  bool replaying = false;
  bool paused = false;
  bool pluggedIn = true; ///< of the virtual board
};

/// Where the reports come from: boards with their state, the virtual board with its faults, a recording.
class LiveSourcePanel : public QWidget {
  Q_OBJECT

public:
  explicit LiveSourcePanel(QWidget* parent = nullptr);

  void display(const LiveSettings& settings);
  void displayState(const LiveSourceState& state);

signals:
  void edited(const QString& what, const LiveSettings& settings);
  void plugAsked(bool in);
  void pauseAsked(bool paused);
  void stepAsked(int frames);
  void openAgainAsked();

private:
  QWidget* buildDevices();
  QWidget* buildScan();
  QWidget* buildSimulation();
  void buildDisturbances(QFormLayout& form);
  void buildFaults(QFormLayout& form);
  template <class Box, class Signal, class Change>
  void follow(Box* box, Signal signal, const QString& what, Change change);
  QWidget* buildReplay();
  void edit(const QString& what, const std::function<void(LiveSettings&)>& change);
  void chooseDevice(int row);
  void listDevices(const LiveSourceState& state);
  void chooseRecording();

  LiveSettings settings_;
  QListWidget* devices_ = nullptr;
  QStringList listed_; ///< what stands in the list, so that it is filled only where that changed
  QLabel* reason_ = nullptr;
  QPushButton* copyRemedy_ = nullptr;
  QPushButton* again_ = nullptr;
  QSpinBox* rate_ = nullptr;
  QComboBox* rows_ = nullptr;
  QGroupBox* simulation_ = nullptr;
  QComboBox* noise_ = nullptr;
  QDoubleSpinBox* warming_ = nullptr;
  QDoubleSpinBox* hysteresis_ = nullptr;
  QSpinBox* openRow_ = nullptr;
  QSpinBox* openColumn_ = nullptr;
  QSpinBox* dropEvery_ = nullptr;
  QPushButton* plug_ = nullptr;
  QGroupBox* replay_ = nullptr;
  QComboBox* speed_ = nullptr;
  QPushButton* pause_ = nullptr;
  QPushButton* step_ = nullptr;
};

} // namespace palp
