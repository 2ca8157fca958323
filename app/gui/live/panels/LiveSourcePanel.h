#pragma once

#include "app/gui/project/LiveSettings.h"
#include "app/gui/widgets/FieldBindings.h"
#include "app/study/live/LiveSession.h"
#include "io/board/HidBoards.h"

#include <QWidget>

class QListWidget;
class QPushButton;

namespace palp {

/// What the panel shows of the running session.
struct LiveSourceState {
  LiveStatus status;
  struct Board : HidBoard {
    bool free = true; ///< no other one of the scene shows it
  };
  std::vector<Board> boards;
  bool replaying = false;
  int rowWires = 0;   ///< of the board, or else of the design
  QString recordings; ///< folder of the last recording; empty: none was made
};

/// Where the reports come from: boards with their state, the simulated one, a recording; and how a board scans.
class LiveSourcePanel : public QWidget {
  Q_OBJECT

public:
  explicit LiveSourcePanel(QWidget* parent = nullptr);

  void display(const LiveSettings& settings);
  void displayState(const LiveSourceState& state);
  /// Another board may be shown in addition to this one.
  void setMoreAllowed(bool allowed);

signals:
  void edited(const QString& what, const LiveSettings& settings);
  void openAgainRequested();
  void anotherRequested();

private:
  QWidget* buildDevices();
  QWidget* buildScan();
  void chooseDevice(int row);
  void listDevices(const LiveSourceState& state);
  void chooseRecording();
  void listRows(int rowWires);

  FieldBindings<LiveSettings> fields_;
  QListWidget* devices_ = nullptr;
  QStringList listed_; ///< the rows of the list, so that it is filled only where they changed
  QString recordings_; ///< folder where recordings are
  QPushButton* again_ = nullptr;
  QPushButton* another_ = nullptr;
  QSpinBox* rate_ = nullptr;
  QComboBox* rows_ = nullptr;
};

} // namespace palp
