#pragma once

#include "app/gui/live/LiveHost.h"
#include "app/gui/live/LiveLamp.h"
#include "app/gui/live/LiveNews.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/window/Scene.h"
#include "app/study/live/trust/DeviationNote.h"

#include <QTimer>

#include <functional>

class QSplitter;
class QTabWidget;

namespace palp {

class HeatmapView;
class LiveBanner;
class LiveCalibration;
class LiveControlPanel;
class LiveCounters;
class LiveCurves;
class LiveSourcePanel;
class LiveModelView;
class LiveView;
class ReplayBar;
class SidePanel;
class SendPanel;
class SimulationPanel;

/// A live board: force vectors, heatmap and curves at no more than 30 frames per second, and only while it is seen.
/// While it is hidden a recording and an alarm that is set continue. Meshes and solves only the model view, on
/// request.
class LivePage : public Scene {
  Q_OBJECT

public:
  explicit LivePage(Workbench& workbench, BoardAccess access = {}, std::size_t board = 0);
  ~LivePage() override;

  [[nodiscard]] Stage stage() const override { return Stage::Design; }
  void setTheme(Theme theme) override;
  [[nodiscard]] bool complete() const override;
  [[nodiscard]] std::vector<JobRunner*> runners() override;
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;
  [[nodiscard]] LiveHost& host() { return host_; }
  /// Labelled frames that are in no file of samples.
  [[nodiscard]] int unsavedFrames() const;
  /// What ends or is lost where this board is closed, in sentences.
  [[nodiscard]] QStringList lossesByClosing() const;
  [[nodiscard]] LiveModelView& twin() { return *modelView_; }
  /// How often the views were brought up to date.
  [[nodiscard]] int looks() const { return looks_; }
  /// Which of the project's boards it shows, from the next change of the project on.
  void setBoard(std::size_t board) { board_ = board; }
  /// Its status for all scenes.
  [[nodiscard]] LiveLampState lamp() const { return watch_.state(host_, isVisible()); }
  /// Another board of the project is requested in addition to this one.
  void setMoreAllowed(bool allowed);
  /// It shares the window with others: where it is too narrow for views next to its panel, the panel replaces them.
  void setBeside(bool beside);

signals:
  void message(const QString& sentence);
  void anotherRequested();
  void sceneRequested(const QString& name);
  /// After each look, seen or hidden.
  void looked();

protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  QWidget* buildPanels();
  QWidget* buildViews();
  void buildKeys();
  void connectPanels();
  void connectSimulation();
  void displayProject();
  void draw();
  void edit(const QString& what, const LiveSettings& settings);
  void change(const QString& what, const std::function<void(LiveSettings&)>& change);
  void refuseNetwork(const QString& sentence);
  void look();
  void lookHidden();
  void announce();
  void arrangeViews();
  void placeHeatmap(bool inTab);
  void drawState();
  void drawForces();
  void drawHeatmap();
  void drawCurves();
  void toggleCell(int row, int column);
  void tare();
  void exportFrames(const QString& file);
  void exportRecording(const QString& file);
  void record(const QString& file, bool replace);
  [[nodiscard]] bool endsRecording(const Leaving& leaving) const;
  [[nodiscard]] QString recordingEnds() const;
  void takeNetworkInUse();
  void stopRecording();
  void solveModelView();
  void prepareNetwork(const QString& rows);
  [[nodiscard]] const LiveSettings& settings() const { return workbench_.project().board(board_); }

  Workbench& workbench_;
  std::size_t board_;
  LiveHost host_;
  QTimer timer_;
  QTimer hiddenTimer_; ///< runs only while something is done out of sight
  JobRunner exporter_{JobRunner::Orders::Each};
  LiveWatch watch_;
  LiveNews news_;
  LiveSourcePanel* source_ = nullptr;
  SimulationPanel* simulation_ = nullptr;
  SendPanel* send_ = nullptr;
  LiveControlPanel* control_ = nullptr;
  LiveCounters* counters_ = nullptr;
  LiveBanner* banner_ = nullptr;
  ReplayBar* replay_ = nullptr;
  SidePanel* panels_ = nullptr;
  QWidget* views_ = nullptr; ///< all views next to the panels
  QSplitter* upper_ = nullptr;
  QTabWidget* blockTabs_ = nullptr;
  QTabWidget* curveTabs_ = nullptr;
  LiveView* block_ = nullptr;
  LiveModelView* modelView_ = nullptr;
  HeatmapView* heatmap_ = nullptr;
  LiveCurves* curves_ = nullptr;
  LiveCalibration* calibration_ = nullptr;
  Eigen::MatrixXd drawnChange_;
  DeviationNote note_; ///< of the network in use
  int looks_ = 0;
  int stateLook_ = 0;
  int hiddenLooks_ = 0;
  bool arrowSeen_ = false;
  bool beside_ = false;
  double shownSince_s_ = 0;
};

} // namespace palp
