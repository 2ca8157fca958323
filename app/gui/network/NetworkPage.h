#pragma once

#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/window/Scene.h"

#include <array>
#include <filesystem>
#include <vector>

class QLabel;
class QLayout;
class QPushButton;
class QScrollArea;
class QSpinBox;
class QTabWidget;

namespace palp {

class ChartView;
class DecodersTab;
class NetworkBound;
class NetworkFiles;
class NetworkPanel;
class SweepTab;
class TouchBounds;
class TrainedNetworks;

/// Samples, training and the sweep of the spread, with the paper's numbers.
class NetworkPage : public Scene {
  Q_OBJECT

public:
  NetworkPage(Workbench& workbench, NetworkSession& session, QWidget* parent = nullptr);

  /// Samples come from commands of their own, never from the chain.
  [[nodiscard]] Stage stage() const override { return Stage::Design; }
  /// Asks where samples that took long would be replaced.
  void openSamples(const std::vector<std::filesystem::path>& files);
  /// The user chooses tables of measured data, or samples.
  void chooseTables();
  void setTheme(Theme theme) override;
  [[nodiscard]] bool complete() const override { return true; }
  [[nodiscard]] std::vector<JobRunner*> runners() override;
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;

signals:
  void sceneRequested(const QString& scene);
  void importRequested(const QStringList& tables);
  /// The file of the network that Live decodes with holds another one.
  void liveNetworkReplaced();

protected:
  void showEvent(QShowEvent* event) override;

private:
  QWidget* buildCharts();
  QLayout* buildBar();
  QWidget* buildFit();
  void displayProject();
  void takeSampleSettings();
  void displaySamples();
  /// To choose from: imported samples may have others than the design.
  [[nodiscard]] std::array<int, 2> rowWiresAndAreas() const;
  void displayReadiness();
  void displaySweep();
  void displayWords();
  void displayFit();
  void displayTrials();
  void drawCharts();
  void edit(const QString& what, const SampleSettings& samples, const NetworkSettings& network);
  void connectSession();
  void showProblem(const QString& sentence);
  void showSentence(const QString& sentence, const char* role);
  void takeOver(const QString& what, const NetworkSettings& network);
  void goBackTo(std::size_t network);

  Workbench& workbench_;
  NetworkSession& session_;
  NetworkBound* bound_;
  TouchBounds* touchBounds_;
  NetworkFiles* files_;
  bool editing_ = false;          ///< by the panel: what follows is trained
  NetworkSettings settingsShown_; ///< with which the words of the fit were made
  std::array<int, 2> choices_{};  ///< rowWiresAndAreas() that are shown
  NetworkPanel* panel_ = nullptr;
  QLabel* fitWords_ = nullptr;
  QScrollArea* head_ = nullptr;         ///< around them
  const NetworkFit* wordsOf_ = nullptr; ///< only compared
  QLabel* problem_ = nullptr;
  QSpinBox* area_ = nullptr;
  QPushButton* save_ = nullptr;
  QPushButton* open_ = nullptr;
  QPushButton* live_ = nullptr;
  QTabWidget* tabs_ = nullptr;
  SweepTab* sweep_ = nullptr;
  std::array<ChartView*, 3> decoupled_{};
  ChartView* place_ = nullptr; ///< seen where places are learned
  ChartView* relative_ = nullptr;
  DecodersTab* decoders_ = nullptr;
  TrainedNetworks* trained_ = nullptr;
};

} // namespace palp
