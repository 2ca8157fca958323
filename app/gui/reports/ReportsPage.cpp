#include "app/gui/reports/ReportsPage.h"

#include "app/gui/jobs/TimeLeft.h"
#include "app/gui/project/Command.h"
#include "app/gui/reports/PageWords.h"
#include "app/gui/reports/ReportCases.h"
#include "app/gui/reports/ReportKinds.h"
#include "app/gui/reports/ReportPicture.h"
#include "app/gui/reports/StudyForm.h"
#include "app/gui/reports/WrittenReports.h"
#include "app/gui/widgets/MakeWidgets.h"
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
#include <QPlainTextEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollBar>
#include <QSettings>
#include <QSpinBox>
#include <QSplitter>
#include <QStandardPaths>
#include <QTabWidget>
#include <QUrl>
#include <QVBoxLayout>

namespace palp {

namespace {

constexpr const char* kFolderKey = "reportsFolder";
constexpr const char* kPage = "report.html";

/// The messages of its run; empty where they were not kept.
QString messagesIn(const QString& folder) {
  QFile messages(QDir(folder).filePath(kReportMessages));
  return messages.open(QIODevice::ReadOnly) ? QString::fromUtf8(messages.readAll()) : QString();
}

} // namespace

ReportsPage::ReportsPage(Workbench& workbench, QWidget* parent)
    : Scene(parent), workbench_(workbench), program_(QDir(QCoreApplication::applicationDirPath()).filePath("palp")) {
  build();
  connect(start_, &QPushButton::clicked, this, &ReportsPage::start);
  connect(cancel_, &QPushButton::clicked, &run_, &ReportRun::cancel);
  connect(openPage_, &QPushButton::clicked, this,
          [this] { openOnDesktop(QDir(shown_).filePath(kPage), tr("The page")); });
  connect(openFolder_, &QPushButton::clicked, this, [this] { openOnDesktop(shown_, tr("The folder")); });
  connect(&run_, &ReportRun::said, log_, &QPlainTextEdit::appendPlainText);
  connect(&run_, &ReportRun::progressed, this, &ReportsPage::setProgress);
  connect(&run_, &ReportRun::ended, this, &ReportsPage::end);
  connect(pictures_, &QListWidget::currentTextChanged, picture_,
          [this](const QString& file) { picture_->show(QDir(shown_).filePath(file)); });
  connect(picture_, &ReportPicture::message, this, &ReportsPage::say);
  connect(showNew_, &QPushButton::clicked, this, [this] { showWritten(pageFolder(runFolder_)); });
  connect(written_, &WrittenReports::chosen, this, &ReportsPage::showWritten);
  connect(&workbench_, &Workbench::projectChanged, this, &ReportsPage::planAgain);
  timer_.setInterval(500);
  connect(&timer_, &QTimer::timeout, this, &ReportsPage::showTime);
  chooseKind();
}

ReportsPage::~ReportsPage() {
  run_.disconnect(this);
  if (!run_.running()) return;
  run_.kill();
  tidyReport(runFolder_, log_->toPlainText()); // quitting leaves no empty folder either
}

void ReportsPage::build() {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(8, 8, 8, 8);
  column->addLayout(buildBar());
  what_ = textLabel("reportWhat", "hint");
  connect(kind_, &QComboBox::currentIndexChanged, this, &ReportsPage::chooseKind);
  column->addWidget(what_);
  study_ = new StudyForm(workbench_);
  connect(study_, &StudyForm::changed, this, [this] {
    if (isStudy()) chooseKind();
  });
  addTo(*column, {study_, buildFolder(), buildState(), {buildViews(), 1}});
}

QLayout* ReportsPage::buildBar() {
  kind_ = choiceBox("reportKind", {}, tr("Which report"), tr("Report"));
  for (const ReportKind& kind : reportKinds()) {
    kind_->addItem(kind.title);
    kind_->setItemData(kind_->count() - 1, kind.what, Qt::ToolTipRole);
  }
  start_ = pushButton(tr("Run"), "runReport", tr("Runs the report in the background"));
  cancel_ = pushButton(tr("Cancel"), "cancelReport", tr("Cancels the report"));
  openPage_ = pushButton(tr("Open the page"), "openReport",
                         tr("Opens report.html in the browser; it is a single file that needs no internet"));
  openFolder_ =
      pushButton(tr("Open the folder"), "openReportFolder", tr("Opens the folder with page, CSV and pictures"));
  auto* bar = new QHBoxLayout;
  bar->addWidget(kind_);
  buildSamplesBox();
  bar->addWidget(perArea_);
  for (QPushButton* push : {start_, cancel_}) bar->addWidget(push);
  bar->addStretch(1);
  for (QPushButton* push : {openPage_, openFolder_}) bar->addWidget(push);
  for (QPushButton* push : {cancel_, openPage_, openFolder_}) push->setEnabled(false);
  return bar;
}

QLayout* ReportsPage::buildFolder() {
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  target_ = new QLineEdit(QSettings().value(kFolderKey, QDir(documents).filePath("palp-reports")).toString());
  target_->setObjectName("reportFolder");
  target_->setAccessibleName(tr("Folder of all reports"));
  target_->setToolTip(tr("Folder in which reports are saved: each run creates its own folder there, named after the "
                         "report and the time; existing folders are left unchanged"));
  connect(target_, &QLineEdit::editingFinished, this, &ReportsPage::listReports);
  auto* choose = pushButton(tr("Folder..."), "chooseReportFolder", tr("Selects the folder in which reports are saved"));
  connect(choose, &QPushButton::clicked, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Folder of the reports"), target_->text());
    if (folder.isEmpty()) return;
    target_->setText(folder);
    listReports();
  });
  auto* words = new QLabel(tr("Save to"));
  words->setBuddy(target_);
  return inRow({words, {target_, 1}, choose});
}

QLayout* ReportsPage::buildState() {
  bar_ = new QProgressBar;
  bar_->setFixedWidth(160);
  bar_->setRange(0, 1000);
  bar_->hide();
  state_ = textLabel("reportState");
  state_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard); // paths are copied
  state_->setMinimumHeight(bar_->sizeHint().height()); // what is below stays where it is
  showNew_ = pushButton(tr("Show the new report"), "showNewReport",
                        tr("Shows the report that has just finished instead of the selected one"));
  showNew_->hide();
  return inRow({bar_, {state_, 1}, showNew_});
}

QWidget* ReportsPage::buildViews() {
  cases_ = new ReportCases;
  log_ = new QPlainTextEdit;
  log_->setObjectName("reportLog");
  log_->setAccessibleName(tr("Messages of the report"));
  log_->setReadOnly(true);
  log_->setLineWrapMode(QPlainTextEdit::NoWrap); // tables
  log_->setPlaceholderText(tr("Messages of the report while it runs."));
  log_->setFont(QFontDatabase::systemFont(QFontDatabase::FixedFont));
  written_ = new WrittenReports;
  pictures_ = new QListWidget;
  pictures_->setObjectName("reportPictures");
  pictures_->setAccessibleName(tr("Pictures of the report"));
  pictures_->hide(); // while there are none
  picture_ = new ReportPicture(tr("Pictures of the report appear here."));
  tabs_ = new QTabWidget;
  tabs_->setObjectName("reportTabs");
  tabs_->addTab(cases_, tr("Parts"));
  tabs_->addTab(log_, tr("Messages"));
  pageWords_ = new PageWords;
  tabs_->addTab(pageWords_, tr("Text and tables"));
  tabs_->addTab(written_, tr("Earlier reports"));
  auto* left = new QSplitter(Qt::Vertical);
  left->setObjectName("reportsLeft");
  for (QWidget* part : {static_cast<QWidget*>(tabs_), static_cast<QWidget*>(pictures_)}) left->addWidget(part);
  auto* views = new QSplitter(Qt::Horizontal);
  views->setObjectName("reportsSplitter");
  views->addWidget(left);
  whose_ = new QLabel; // another kind may be chosen above
  whose_->setObjectName("reportShown");
  auto* below = new QVBoxLayout(new QWidget);
  below->setContentsMargins(0, 0, 0, 0);
  below->addWidget(whose_);
  below->addWidget(picture_, 1);
  views->addWidget(below->parentWidget());
  views->setSizes({620, 800}); // the names of all tabs
  return views;
}

QString ReportsPage::base() const {
  return QDir(target_->text().trimmed()).absolutePath();
}

void ReportsPage::showEvent(QShowEvent* event) {
  Scene::showEvent(event);
  listReports();
  planAgain();
}

void ReportsPage::start() {
  QStringList all;
  runFolder_.clear();
  try {
    runFolder_ =
        isStudy() ? study_->runFolder(base()) : newReportFolder(base(), runName(kind()), QDateTime::currentDateTime());
    all = runArguments(runFolder_);
    if (ofAnotherDesign(all, workbench_.project()))
      saveDesign(QDir(runFolder_).filePath(kReportDesign).toStdString(), workbench_.project().design, true);
  } catch (const Error& error) {
    tidyReport(runFolder_, {});
    state_->setText(QString::fromStdString(error.what()));
    return;
  }
  QSettings().setValue(kFolderKey, base());
  chooseKind();
  log_->setPlainText("palp " + all.join(' '));
  if (!openPage_->isEnabled()) showFolder({}, false); // else what is looked at stays
  showNew_->hide();
  note_.clear();
  // The focus of a button that turns grey goes to the next field, which marks all that it holds.
  if (start_->hasFocus() || kind_->hasFocus()) setFocus(Qt::OtherFocusReason);
  start_->setEnabled(false);
  kind_->setEnabled(false);
  cancel_->setEnabled(true);
  bar_->setValue(0);
  bar_->show();
  share_ = 0;
  moments_.clear();
  run_.start(program_, all);
  showTime();
  timer_.start();
}

void ReportsPage::setProgress(double share, const QString& what) {
  share_ = share;
  if (moments_.empty() || share > moments_.back().share) moments_.push_back({share, run_.seconds()});
  bar_->setValue(qRound(1000 * share));
  cases_->setProgress(share, run_.seconds(), what);
}

void ReportsPage::end(ReportRun::Ending how) {
  timer_.stop();
  emit runs({});
  bar_->hide();
  start_->setEnabled(true);
  kind_->setEnabled(true);
  if (cancel_->hasFocus()) start_->setFocus(Qt::OtherFocusReason);
  cancel_->setEnabled(false);
  log_->verticalScrollBar()->setValue(log_->verticalScrollBar()->maximum());
  const bool done = how == ReportRun::Ending::Done;
  const std::vector<double> took = done ? cases_->finish(run_.seconds()) : std::vector<double>{};
  if (done && !isStudy()) plan_->remember(took, moments_);
  if (!done) cases_->stop();
  state_->setText(
      how == ReportRun::Ending::NotStarted
          ? tr("%1 cannot be started; it is built together with this program and must be in the same folder.")
                .arg(program_)
          : endWords(how, run_.seconds(), run_.status(), runFolder_));
  emit message(tr("Report %1: %2").arg(QDir(runFolder_).dirName(), state_->text()));
  if (how == ReportRun::Ending::NoResult || how == ReportRun::Ending::Failed) tabs_->setCurrentWidget(log_);
  tidyReport(runFolder_, log_->toPlainText());
  offerRun(done);
  if (isStudy() && how == ReportRun::Ending::Cancelled && QFileInfo::exists(runFolder_)) study_->goOnIn(runFolder_);
  listReports();
}

void ReportsPage::offerRun(bool done) {
  if (!QFileInfo::exists(runFolder_)) return;
  if (openPage_->isEnabled())
    showNew_->setVisible(done);
  else
    showFolder(pageFolder(runFolder_), done);
  if (done && tabs_->currentWidget() == cases_ && !showNew_->isVisible()) tabs_->setCurrentWidget(pageWords_);
}

QStringList ReportsPage::exportFiles() const {
  QStringList files;
  if (!openPage_->isEnabled()) return files;
  const QDir folder(shown_);
  for (const QString& name : folder.entryList({"*.png", "*.csv"}, QDir::Files, QDir::Name))
    files << folder.filePath(name);
  return files;
}

void ReportsPage::listReports() {
  written_->list(base(), shown_, run_.running() ? runFolder_ : QString());
  tabs_->setTabText(tabs_->indexOf(written_), tr("Earlier reports (%1)").arg(written_->count()));
}

void ReportsPage::showWritten(const QString& folder) {
  const bool running = run_.running(); // its kind, its time and its messages stay visible
  if (QFileInfo::exists(QDir(folder).filePath(kStudyFile)))
    return running ? say(tr("A cancelled study can be continued when this report is done.")) : showUnfinished(folder);
  if (!QFileInfo::exists(QDir(folder).filePath(kPage))) {
    say(tr("%1 no longer exists.").arg(folder));
    listReports();
    return;
  }
  showNew_->hide();
  note_.clear();
  if (running) return showFolder(folder, true);
  const QString messages = messagesIn(folder);
  log_->setPlainText(messages.isEmpty() ? tr("%1 contains no messages of its run.").arg(folder) : messages);
  chooseKindOf(folder);
  showFolder(folder, true);
  state_->setText(tr("Shown again: %1").arg(QDir(folder).filePath(kPage)));
}

void ReportsPage::openStudy(const QString& file) {
  const StudyPlan plan = loadStudy(file.toStdString());
  if (running()) throw Error("a report is running; open the study when it is done");
  kind_->setCurrentIndex(studyIndex());
  study_->show(plan);
}

QString ReportsPage::endsWords() const {
  return isStudy() ? tr("A study is running and will be cancelled; finished designs are kept, and it can be continued "
                        "from Earlier reports.")
                   : tr("A report is running and will be cancelled; its results are lost.");
}

/// Shows its form again, so that Run continues it.
void ReportsPage::showUnfinished(const QString& folder) {
  try {
    openStudy(QDir(folder).filePath(kStudyFile));
    study_->goOnIn(folder);
    state_->setText(studyState(folder, study_->plan().designs()));
  } catch (const Error& error) {
    state_->setText(QString::fromStdString(error.what()));
  }
}

void ReportsPage::showFolder(const QString& folder, bool page) {
  shown_ = folder;
  written_->mark(folder);
  openPage_->setEnabled(page);
  openFolder_->setEnabled(!folder.isEmpty());
  pictures_->clear();
  picture_->clear();
  whose_->setText(page ? titleOfReport(folder) : QString());
  pageWords_->show(page ? QDir(folder).filePath(kPage) : QString());
  if (page) pictures_->addItems(QDir(folder).entryList({"*.png"}, QDir::Files, QDir::Name));
  pictures_->setVisible(pictures_->count() > 0);
  if (pictures_->count() > 0)
    pictures_->setCurrentRow(0);
  else if (page)
    picture_->say(tr("This report has no pictures. Its messages:\n\n%1").arg(messagesIn(folder)));
}

void ReportsPage::say(const QString& sentence) {
  note_ = sentence;
  emit message(sentence);
  if (run_.running())
    showTime();
  else
    state_->setText(sentence);
}

/// The desktop does not report whether a program started, so the path is always shown.
void ReportsPage::openOnDesktop(const QString& path, const QString& what) {
  const bool asked = QDesktopServices::openUrl(QUrl::fromLocalFile(path));
  say(asked ? tr("Opened %1 in your default application. If nothing appears, open %2.").arg(what, path)
            : tr("No application on this computer opens %1; open it yourself: %2").arg(what, path));
}

double ReportsPage::left_s() const {
  return plan_->left_s(moments_.empty() ? RunMoment{} : moments_.back(), run_.seconds());
}

void ReportsPage::showTime() {
  const QString left = share_ < 1 ? roughly(left_s()) : QString();
  state_->setText(tr("Running for %1 s.").arg(static_cast<int>(run_.seconds())) +
                  (left.isEmpty() ? QString() : tr(" About %1 left.").arg(left)) +
                  (note_.isEmpty() ? QString() : " " + note_));
  emit runs(tr("Report %1: %2 %").arg(QDir(runFolder_).dirName()).arg(qRound(100 * share_)) +
            (left.isEmpty() ? QString() : tr(", about %1 left").arg(left)));
}

} // namespace palp
