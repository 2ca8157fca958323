#pragma once

#include "app/gui/project/Workbench.h"
#include "app/gui/window/Scene.h"

#include <QDateTime>
#include <QElapsedTimer>
#include <QProcess>
#include <QTimer>

class QComboBox;
class QLayout;
class QLabel;
class QLineEdit;
class QListWidget;
class QPlainTextEdit;
class QProgressBar;
class QPushButton;

namespace palp {

class ReportPicture;

/// The reports, run by the command line program beside this one, so that a report can neither block nor break the
/// window; its page and pictures are shown when it is done.
class ReportsPage : public Scene {
  Q_OBJECT

public:
  explicit ReportsPage(Workbench& workbench, QWidget* parent = nullptr);
  ~ReportsPage() override;

  [[nodiscard]] Stage stage() const override { return Stage::Design; }
  void setTheme(Theme) override {}
  [[nodiscard]] bool complete() const override { return true; }
  [[nodiscard]] QString commands(const Project& project, const QString& designFile) const override;

  /// Another program in place of the palp that lies beside this one.
  void setProgram(const QString& program) { program_ = program; }

private:
  void build();
  QLayout* buildBar();
  QLayout* buildState();
  QWidget* buildViews();
  /// Of palp, for the chosen report into a folder.
  [[nodiscard]] QStringList arguments(const Project& project, const QString& folder) const;
  void start();
  void cancel();
  void readMessages();
  void end(int status, QProcess::ExitStatus how);
  void ended();
  void showPictures();
  [[nodiscard]] QStringList filesOfThisRun(const QString& pattern) const;
  void showTime();

  Workbench& workbench_;
  QString program_;
  QProcess process_;
  QElapsedTimer clock_;
  QTimer timer_;
  QString folder_;    ///< of the last run
  QDateTime started_; ///< of the last run
  bool cancelled_ = false;
  QComboBox* kind_ = nullptr;
  QLabel* what_ = nullptr;
  QLineEdit* target_ = nullptr;
  QPushButton* run_ = nullptr;
  QPushButton* cancel_ = nullptr;
  QPushButton* openPage_ = nullptr;
  QPushButton* openFolder_ = nullptr;
  QProgressBar* bar_ = nullptr;
  QLabel* state_ = nullptr;
  QPlainTextEdit* log_ = nullptr;
  QListWidget* pictures_ = nullptr;
  ReportPicture* picture_ = nullptr;
};

} // namespace palp
