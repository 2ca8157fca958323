#pragma once

#include "app/gui/project/LiveSettings.h"
#include "app/study/live/LiveSession.h"

#include <QWidget>

#include <functional>

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QSpinBox;

namespace palp {

/// What is done with the frames: network, tare, recording, marks, and the scales of the views.
class LiveControlPanel : public QWidget {
  Q_OBJECT

public:
  explicit LiveControlPanel(QWidget* parent = nullptr);

  void display(const LiveSettings& settings);
  /// `network` in words: decoder, wires, noise.
  void displayState(const LiveStatus& status, bool paused, const QString& network);
  /// Text for the next mark.
  [[nodiscard]] QString markText() const;

signals:
  void edited(const QString& what, const LiveSettings& settings);
  void tareAsked();
  void clearTareAsked();
  void pauseAsked(bool paused);
  void markAsked(const QString& text);
  void recordAsked(const QString& file);
  void stopRecordingAsked();
  void exportAsked(const QString& file);

private:
  QWidget* buildNetwork();
  QWidget* buildRecording();
  QWidget* buildScales();
  void edit(const QString& what, const std::function<void(LiveSettings&)>& change);
  void chooseNetwork();
  void record();

  LiveSettings settings_;
  QLabel* network_ = nullptr;
  QLabel* networkProblem_ = nullptr;
  QPushButton* shipped_ = nullptr;
  QSpinBox* tareFrames_ = nullptr;
  QPushButton* tare_ = nullptr;
  QPushButton* clearTare_ = nullptr;
  QPushButton* pause_ = nullptr;
  QLineEdit* file_ = nullptr;
  QPushButton* record_ = nullptr;
  QLabel* recorded_ = nullptr;
  QLineEdit* mark_ = nullptr;
  int marks_ = 0;
  QDoubleSpinBox* arrow_ = nullptr;
  QComboBox* change_ = nullptr;
  QSpinBox* window_ = nullptr;
};

} // namespace palp
