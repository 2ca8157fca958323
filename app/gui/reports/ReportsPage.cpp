#include "app/gui/reports/ReportsPage.h"

#include "app/gui/project/Command.h"
#include "app/gui/reports/ReportPicture.h"
#include "app/study/reports/ReportComputations.h"
#include "io/DesignFile.h"
#include "model/base/Error.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QDesktopServices>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QFontDatabase>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPixmap>
#include <QPlainTextEdit>
#include <QProcessEnvironment>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollBar>
#include <QSettings>
#include <QSplitter>
#include <QStandardPaths>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <csignal>

namespace palp {

namespace {

constexpr int kFileClock_ms = 10; // by which the time of a file may lie before that of the clock
constexpr int kEndWithin_ms = 3000;
constexpr const char* kFolderKey = "reportFolder";

struct Kind {
  QString title;
  QStringList arguments;
  QString what;
};

std::vector<Kind> kinds() {
  std::vector<Kind> all{
      {QObject::tr("reproduce the paper"),
       {"reproduce", "all"},
       QObject::tr("Table 1, Fig. 12 and the figures of the paper from nothing, the printed numbers beside ours.")},
      {QObject::tr("reproduce Table 1"),
       {"reproduce", "table1"},
       QObject::tr("Errors from displacements at the paper's spreads, both modes and the linear baseline.")},
      {QObject::tr("reproduce Fig. 12"),
       {"reproduce", "fig12"},
       QObject::tr("Errors from resistances over the spread, both modes and the linear baseline.")}};
  for (const ReportComputation& report : reportComputations())
    all.push_back({QString::fromStdString(report.name),
                   {"report", QString::fromStdString(report.name)},
                   QString::fromStdString(report.what)});
  return all;
}

QString commandLineProgram() {
  return QDir(QCoreApplication::applicationDirPath()).filePath("palp");
}

QPushButton* button(const QString& text, const QString& name, const QString& tip) {
  auto* push = new QPushButton(text);
  push->setObjectName(name);
  push->setToolTip(tip);
  return push;
}

} // namespace

ReportsPage::ReportsPage(Workbench& workbench, QWidget* parent)
    : Scene(parent), workbench_(workbench), program_(commandLineProgram()) {
  build();
  connect(run_, &QPushButton::clicked, this, &ReportsPage::start);
  connect(cancel_, &QPushButton::clicked, this, &ReportsPage::cancel);
  connect(openPage_, &QPushButton::clicked, this,
          [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(QDir(folder_).filePath("report.html"))); });
  connect(openFolder_, &QPushButton::clicked, this,
          [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(folder_)); });
  process_.setProcessChannelMode(QProcess::MergedChannels);
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  environment.insert("PALP_PROGRESS_LINES", "1");
  process_.setProcessEnvironment(environment);
  connect(&process_, &QProcess::readyRead, this, &ReportsPage::readMessages);
  connect(&process_, &QProcess::finished, this, &ReportsPage::end);
  connect(&process_, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error != QProcess::FailedToStart) return; // finished() comes as well
    ended();
    state_->setText(
        tr("%1 cannot be started; it is built together with this program and lies beside it.").arg(process_.program()));
  });
  connect(pictures_, &QListWidget::currentTextChanged, picture_,
          [this](const QString& file) { picture_->show(QPixmap(QDir(folder_).filePath(file))); });
  timer_.setInterval(500);
  connect(&timer_, &QTimer::timeout, this, &ReportsPage::showTime);
}

ReportsPage::~ReportsPage() {
  process_.disconnect(this);
  if (process_.state() == QProcess::NotRunning) return;
  process_.terminate();
  if (!process_.waitForFinished(kEndWithin_ms)) process_.kill();
}

void ReportsPage::build() {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addLayout(buildBar());
  what_ = new QLabel(kinds().front().what);
  what_->setProperty("role", "hint");
  what_->setWordWrap(true);
  connect(kind_, &QComboBox::currentIndexChanged, this,
          [this](int k) { what_->setText(kinds()[static_cast<std::size_t>(k)].what); });
  column->addWidget(what_);
  column->addLayout(buildState());
  column->addWidget(buildViews(), 1);
}

QLayout* ReportsPage::buildBar() {
  kind_ = new QComboBox;
  kind_->setObjectName("reportKind");
  kind_->setToolTip(tr("Which report"));
  for (const Kind& kind : kinds()) kind_->addItem(kind.title);
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  target_ = new QLineEdit(QSettings().value(kFolderKey, QDir(documents).filePath("palp-report")).toString());
  target_->setObjectName("reportFolder");
  target_->setToolTip(tr("Folder of report.html, CSV and pictures; what it holds of an earlier run is replaced"));
  auto* choose = button(tr("Folder..."), "chooseReportFolder", tr("Chooses the folder"));
  connect(choose, &QPushButton::clicked, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder of the report"), target_->text());
    if (!folder.isEmpty()) target_->setText(folder);
  });
  run_ = button(tr("Run"), "runReport", tr("Runs the report beside the window, which stays free"));
  cancel_ = button(tr("Cancel"), "cancelReport", tr("Stops the report"));
  openPage_ = button(tr("Open the page"), "openReport", tr("Opens report.html in the browser: one file, no network"));
  openFolder_ = button(tr("Open the folder"), "openReportFolder", tr("Page, CSV and pictures, to be passed on"));
  auto* bar = new QHBoxLayout;
  bar->addWidget(kind_);
  bar->addWidget(target_, 1);
  for (QPushButton* push : {choose, run_, cancel_, openPage_, openFolder_}) bar->addWidget(push);
  for (QPushButton* push : {cancel_, openPage_, openFolder_}) push->setEnabled(false);
  return bar;
}

QLayout* ReportsPage::buildState() {
  bar_ = new QProgressBar;
  bar_->setFixedWidth(160);
  bar_->setRange(0, 0);
  bar_->hide();
  state_ = new QLabel(tr("Nothing was run yet."));
  state_->setObjectName("reportState");
  state_->setMinimumHeight(bar_->sizeHint().height()); // what is below stays where it is
  auto* state = new QHBoxLayout;
  state->addWidget(bar_);
  state->addWidget(state_, 1);
  return state;
}

QWidget* ReportsPage::buildViews() {
  log_ = new QPlainTextEdit;
  log_->setObjectName("reportLog");
  log_->setReadOnly(true);
  log_->setLineWrapMode(QPlainTextEdit::NoWrap); // tables
  log_->setPlaceholderText(tr("What the report says while it runs."));
  log_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  pictures_ = new QListWidget;
  pictures_->setObjectName("reportPictures");
  pictures_->hide(); // while there are none
  picture_ = new ReportPicture(tr("Pictures of the report appear here."));
  auto* left = new QSplitter(Qt::Vertical);
  left->setObjectName("reportsLeft");
  left->addWidget(log_);
  left->addWidget(pictures_);
  auto* views = new QSplitter(Qt::Horizontal);
  views->setObjectName("reportsSplitter");
  views->addWidget(left);
  views->addWidget(picture_);
  views->setSizes({480, 900});
  return views;
}

QStringList ReportsPage::arguments(const Project& project, const QString& folder) const {
  QStringList all = kinds()[static_cast<std::size_t>(kind_->currentIndex())].arguments;
  if (all.front() == "report") all << "--per-area" << QString::number(project.samples.perArea);
  return all + meshOption(project.mesh).split(' ', Qt::SkipEmptyParts) + QStringList{"-o", folder, "--force"};
}

QString ReportsPage::commands(const Project& project, const QString& designFile) const {
  QStringList all = arguments(project, "palp-report");
  if (all.front() == "report" && !(project.design == paperDesign())) all << "--design" << designFile;
  return "palp " + all.join(' ');
}

void ReportsPage::start() {
  folder_ = QDir(target_->text().trimmed()).absolutePath();
  QStringList all = arguments(workbench_.project(), folder_);
  if (!QDir().mkpath(folder_)) {
    state_->setText(tr("%1 cannot be made; choose a folder that may be written to.").arg(folder_));
    return;
  }
  if (all.front() == "report" && !(workbench_.project().design == paperDesign())) {
    const QString design = QDir(folder_).filePath("sensor.json");
    try {
      saveDesign(design.toStdString(), workbench_.project().design, true);
    } catch (const Error& error) {
      state_->setText(QString::fromStdString(error.what()));
      return;
    }
    all << "--design" << design;
  }
  QSettings().setValue(kFolderKey, folder_);
  log_->setPlainText("palp " + all.join(' '));
  pictures_->clear();
  pictures_->hide();
  picture_->clear();
  cancelled_ = false;
  started_ = QDateTime::currentDateTime().addMSecs(-kFileClock_ms);
  run_->setEnabled(false);
  cancel_->setEnabled(true);
  openPage_->setEnabled(false);
  openFolder_->setEnabled(false);
  bar_->setRange(0, 0);
  bar_->show();
  clock_.start();
  timer_.start();
  process_.start(program_, all);
}

void ReportsPage::readMessages() {
  while (process_.canReadLine()) {
    const QString line = QString::fromUtf8(process_.readLine()).trimmed();
    const QStringList words = line.split(' ');
    if (words.size() != 3 || words.front() != "progress") {
      if (!line.isEmpty()) log_->appendPlainText(line);
      continue;
    }
    bar_->setRange(0, words[2].toInt());
    bar_->setValue(words[1].toInt());
  }
}

void ReportsPage::cancel() {
  if (process_.state() == QProcess::NotRunning) return;
  cancelled_ = true;
  ::kill(static_cast<pid_t>(process_.processId()), SIGINT);
}

void ReportsPage::end(int status, QProcess::ExitStatus how) {
  readMessages();
  log_->appendPlainText(QString::fromUtf8(process_.readAll()).trimmed()); // a last line without an end
  log_->verticalScrollBar()->setValue(log_->verticalScrollBar()->maximum());
  ended();
  const QString seconds = QString::number(1e-3 * static_cast<double>(clock_.elapsed()), 'f', 1);
  if (how == QProcess::NormalExit && status == 0) {
    state_->setText(tr("Done in %1 s: %2").arg(seconds, QDir(folder_).filePath("report.html")));
    openPage_->setEnabled(true);
    openFolder_->setEnabled(true);
    showPictures();
  } else if (cancelled_) {
    const auto written = filesOfThisRun("*").size();
    openFolder_->setEnabled(written > 0);
    state_->setText(written == 0 ? tr("Cancelled after %1 s; nothing was written.").arg(seconds)
                                 : tr("Cancelled after %1 s; %2 of the report's files were already written to %3.")
                                       .arg(seconds, QString::number(written), folder_));
  } else if (status == 130 || status == 1) {
    state_->setText(tr("Ended without a result after %1 s; see the messages.").arg(seconds));
  } else {
    state_->setText(tr("Failed with status %1; see the messages.").arg(status));
  }
}

/// The program does not run any more.
void ReportsPage::ended() {
  timer_.stop();
  bar_->hide();
  run_->setEnabled(true);
  cancel_->setEnabled(false);
}

/// Others in the folder are of another report.
QStringList ReportsPage::filesOfThisRun(const QString& pattern) const {
  QStringList names;
  for (const QFileInfo& file : QDir(folder_).entryInfoList({pattern}, QDir::Files, QDir::Name))
    if (file.lastModified() >= started_) names << file.fileName();
  return names;
}

void ReportsPage::showPictures() {
  pictures_->clear();
  pictures_->addItems(filesOfThisRun("*.png"));
  pictures_->setVisible(pictures_->count() > 0);
  if (pictures_->count() > 0) pictures_->setCurrentRow(0);
}

void ReportsPage::showTime() {
  const qint64 spent_s = clock_.elapsed() / 1000;
  QString words = tr("Running for %1 s; the window stays free.").arg(spent_s);
  const double share = bar_->maximum() > 0 ? static_cast<double>(bar_->value()) / bar_->maximum() : 0;
  if (share > 0.02 && share < 1)
    words += tr(" About %1 s left.").arg(std::ceil(static_cast<double>(spent_s) * (1 - share) / share));
  state_->setText(words);
}

} // namespace palp
