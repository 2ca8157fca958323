#pragma once

#include "app/gui/live/LiveHost.h"
#include "app/gui/project/LiveSettings.h"
#include "app/gui/widgets/FieldBindings.h"
#include "app/study/live/LiveSession.h"

#include <QWidget>

class QLabel;
class QLineEdit;
class QPushButton;

namespace palp {

/// What the panel shows of the running session.
struct LiveControlState {
  LiveStatus status;
  bool paused = false;
  bool replaying = false; ///< what is recorded is a copy of what is played
  double recorded_s = 0;  ///< since the recording was begun
  QString network;        ///< as text: name, decoder, wires, noise
  QString networkBefore;  ///< the one that can be restored; empty: none
};

/// What is done with the frames: network, tare, recording, marks, and the scales of the views.
class LiveControlPanel : public QWidget {
  Q_OBJECT

public:
  explicit LiveControlPanel(QWidget* parent = nullptr);

  /// Record, pause and marks: a box of its own, for who shows it above all others.
  [[nodiscard]] QWidget* recording() const { return recording_; }

  void display(const LiveSettings& settings) { fields_.display(settings); }
  void displayState(const LiveControlState& state);
  /// Why the network that was chosen is not in use; stays until another is.
  void displayNetworkProblem(const QString& sentence);
  /// What is recorded to, or why nothing is.
  void displayRecording(const QString& file, const QString& problem);
  /// Text for the next mark.
  [[nodiscard]] QString markText() const;

signals:
  void edited(const QString& what, const LiveSettings& settings);
  void tareRequested();
  void clearTareRequested();
  /// The network that ships with Palp is wanted in place of one that was refined from it.
  void shippedRequested();
  void pauseRequested(bool paused);
  void markRequested(const QString& text);
  /// The network before is wanted back.
  void backRequested();
  /// A recording is to begin, or the one that runs is to end. `replace`: the user has confirmed that a file of this
  /// name may go.
  void recordRequested(const QString& file, bool replace);
  void exportRequested(const QString& file);

private:
  QWidget* buildNetwork();
  QWidget* buildRecording();
  QWidget* buildAlarm();
  QWidget* buildScales();
  void chooseNetwork();
  void useNetwork(const std::string& file);
  void record();
  void displayTare(const LiveStatus& status);
  void lookForFile();

  FieldBindings<LiveSettings> fields_;
  QWidget* recording_ = nullptr;
  QLabel* network_ = nullptr;
  QLabel* networkProblem_ = nullptr;
  QPushButton* shipped_ = nullptr;
  QPushButton* back_ = nullptr;
  QString networkRefused_;
  QPushButton* tare_ = nullptr;
  QPushButton* clearTare_ = nullptr;
  QLabel* tareState_ = nullptr;
  QPushButton* pause_ = nullptr;
  QLineEdit* file_ = nullptr;
  QPushButton* record_ = nullptr;
  QLabel* recorded_ = nullptr;
  QString replaceable_; ///< the file that the user confirmed to replace
  QString fileThere_;   ///< name of the wanted file where it is there already
  bool records_ = false;
  QString recordedLast_;     ///< of a recording, what it came to
  QString recordingProblem_; ///< stays until the next recording
  QLineEdit* mark_ = nullptr;
  int marks_ = 0;
};

} // namespace palp
