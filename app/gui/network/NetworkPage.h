#pragma once

#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/window/Scene.h"

#include <array>

class QLabel;
class QPushButton;
class QSpinBox;
class QTabWidget;

namespace palp {

class ChartView;
class NetworkPanel;

/// Samples, training and the sweep of the spread, with the paper's numbers beside.
class NetworkPage : public Scene {
  Q_OBJECT

public:
  NetworkPage(Workbench& workbench, NetworkSession& session, QWidget* parent = nullptr);

  /// Samples come from commands of their own, never from the chain.
  [[nodiscard]] Stage stage() const override { return Stage::Design; }
  void setTheme(Theme theme) override;
  [[nodiscard]] bool complete() const override { return true; }
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;

signals:
  void refused(const QString& sentence);

protected:
  void showEvent(QShowEvent* event) override;

private:
  QWidget* buildCharts();
  QWidget* buildTrials();
  ChartView* chart(const char* name);
  void displayProject();
  void displaySamples();
  void displaySweep();
  void displayFit();
  void displayTrials();
  void drawCharts();
  void openSamples();
  void saveSamples();
  void saveNetwork();
  void openNetwork();

  Workbench& workbench_;
  NetworkSession& session_;
  NetworkPanel* panel_ = nullptr;
  QLabel* fitWords_ = nullptr;
  QSpinBox* area_ = nullptr;
  QPushButton* save_ = nullptr;
  QPushButton* open_ = nullptr;
  QTabWidget* tabs_ = nullptr;
  ChartView* error_ = nullptr;
  ChartView* leaveOneOut_ = nullptr;
  ChartView* condition_ = nullptr;
  ChartView* time_ = nullptr;
  std::array<ChartView*, 3> decoupled_{};
  ChartView* relative_ = nullptr;
  ChartView* trialsError_ = nullptr;
  ChartView* trialsTime_ = nullptr;
  QLabel* trialsWords_ = nullptr;
  std::vector<ChartView*> all_;
};

} // namespace palp
