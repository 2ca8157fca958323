#pragma once

#include "app/gui/live/LiveHost.h"

#include <QWidget>

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSlider;

namespace palp {

/// The time line of a recording that is played: hold, step, go anywhere, loop, and back to the board.
class ReplayBar : public QWidget {
  Q_OBJECT

public:
  explicit ReplayBar(LiveHost& host, QWidget* parent = nullptr);

  void display(const LiveSettings& settings);
  /// What has changed since the last look.
  void displayState();

signals:
  void speedRequested(double speed);
  void boardRequested();
  void message(const QString& sentence);

private:
  void buildTimeLine();
  void buildLoop();
  void loop();
  void goTo(double to_s); ///< where that lies outside of the loop, the loop ends
  void listMarks();
  void showSpeed();

  LiveHost& host_;
  QPushButton* pause_ = nullptr;
  QPushButton* step_ = nullptr;
  QSlider* line_ = nullptr;
  QPushButton* back_ = nullptr;
  QDoubleSpinBox* place_ = nullptr;
  QLabel* length_ = nullptr;
  QComboBox* marks_ = nullptr;
  QComboBox* speed_ = nullptr;
  QCheckBox* loop_ = nullptr;
  QDoubleSpinBox* from_ = nullptr;
  QDoubleSpinBox* to_ = nullptr;
  bool sought_ = false; ///< by the number in `place_`
  double length_s_ = -1;
  std::size_t listedMarks_ = 0;
  double speedInUse_ = 1;
};

} // namespace palp
