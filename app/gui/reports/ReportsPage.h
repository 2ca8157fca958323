#pragma once

#include "app/gui/project/Workbench.h"
#include "app/gui/reports/ReportFolders.h"
#include "app/gui/reports/ReportPlan.h"
#include "app/gui/reports/ReportRun.h"
#include "app/gui/window/Scene.h"
#include "app/gui/window/exports/ExportFiles.h"

#include <QTimer>

class QComboBox;
class QLayout;
class QLabel;
class QLineEdit;
class QListWidget;
class QPlainTextEdit;
class QProgressBar;
class QSpinBox;
class QPushButton;
class QTabWidget;

namespace palp {

class ReportCases;
class ReportPicture;
class StudyForm;
class PageWords;
class WrittenReports;
struct ReportKind;

/// The reports, run by the command line program in a process of its own, so that a report can neither block nor break
/// the window; its page and pictures are shown when it is done. Each run has a folder of its own, so that none takes
/// the place of another, and those of before are listed and shown again.
class ReportsPage : public Scene, public ExportFiles {
  Q_OBJECT

public:
  explicit ReportsPage(Workbench& workbench, QWidget* parent = nullptr);
  ~ReportsPage() override;

  [[nodiscard]] Stage stage() const override { return Stage::Design; }
  void setTheme(Theme) override {}
  [[nodiscard]] bool complete() const override { return true; }
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;
  /// The pictures and points of the report that is shown.
  [[nodiscard]] QStringList exportFiles() const override;

  /// Another program instead of the palp in this program's folder.
  void setProgram(const QString& program) { program_ = program; }

  /// Shows the file of a study in the form. Throws Error.
  void openStudy(const QString& file);

  /// What becomes of the report that runs if the window is closed.
  [[nodiscard]] QString endsWords() const;
  [[nodiscard]] bool running() const { return run_.running(); }
  /// Stops a report that runs.
  void cancel() { run_.cancel(); }

signals:
  /// The status of the report for all scenes while it runs; empty: none runs.
  void runs(const QString& words);
  /// How a report ended, and where it lies.
  void message(const QString& sentence);

protected:
  void showEvent(QShowEvent* event) override;

private:
  void build();
  QLayout* buildBar();
  void buildSamplesBox();
  QLayout* buildFolder();
  QLayout* buildState();
  QWidget* buildViews();
  /// Of palp, for the chosen report into a folder.
  [[nodiscard]] QStringList arguments(const Project& project, const QString& folder) const;
  /// The same of a run: also what the command shown by the scene leaves out.
  [[nodiscard]] QStringList runArguments(const QString& folder) const;
  [[nodiscard]] const ReportKind& kind() const;
  [[nodiscard]] bool isStudy() const;
  void planStudy();
  void showUnfinished(const QString& folder);
  [[nodiscard]] QString base() const;
  void chooseKind();
  void planAgain();
  void chooseKindOf(const QString& folder);
  void start();
  void setProgress(double share, const QString& what);
  void end(ReportRun::Ending how);
  /// What came of the run: shown where nothing else is, else offered.
  void offerRun(bool done);
  /// Remaining time of the run [s].
  [[nodiscard]] double left_s() const;
  void showTime();
  /// Shows it; while a report runs, next to its time.
  void say(const QString& sentence);
  void listReports();
  /// One that was written before.
  void showWritten(const QString& folder);
  /// The pictures of the folder, and its buttons.
  void showFolder(const QString& folder, bool page);
  void openOnDesktop(const QString& path, const QString& what);

  Workbench& workbench_;
  QString program_;
  ReportRun run_;
  QTimer timer_;
  std::unique_ptr<ReportPlan> plan_;
  QString planned_;                ///< the settings that it is of
  std::vector<RunMoment> moments_; ///< of the run
  double share_ = 0;
  QString runFolder_; ///< of the run
  QString shown_;     ///< folder of the report that is shown
  QString note_;      ///< shown next to the time of the run
  StudyForm* study_ = nullptr;
  QComboBox* kind_ = nullptr;
  QSpinBox* perArea_ = nullptr; ///< seen where a report draws samples
  QLabel* what_ = nullptr;
  QLineEdit* target_ = nullptr;
  QPushButton* start_ = nullptr;
  QPushButton* cancel_ = nullptr;
  QPushButton* showNew_ = nullptr; ///< the run that is done, while another report is shown
  QPushButton* openPage_ = nullptr;
  QPushButton* openFolder_ = nullptr;
  QProgressBar* bar_ = nullptr;
  QLabel* state_ = nullptr;
  QTabWidget* tabs_ = nullptr;
  ReportCases* cases_ = nullptr;
  QPlainTextEdit* log_ = nullptr;
  PageWords* pageWords_ = nullptr;
  WrittenReports* written_ = nullptr;
  QListWidget* pictures_ = nullptr;
  QLabel* whose_ = nullptr; ///< report that is shown
  ReportPicture* picture_ = nullptr;
};

} // namespace palp
