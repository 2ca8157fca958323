#include "app/gui/window/MessageLog.h"

#include "app/gui/window/LogFile.h"

#include <QLineEdit>
#include <QPlainTextEdit>
#include <QTime>
#include <QVBoxLayout>

namespace palp {

namespace {

constexpr int kMostLines = 1000; ///< of a session of days

} // namespace

MessageLog::MessageLog(QWidget* parent) : QDockWidget(tr("Messages"), parent) {
  setObjectName("messages");
  lines_ = new QPlainTextEdit;
  lines_->setObjectName("messageLines");
  lines_->setAccessibleName(tr("Messages of the window"));
  lines_->setReadOnly(true);
  lines_->setMaximumBlockCount(kMostLines);
  place_ = new QLineEdit;
  place_->setObjectName("logFile");
  place_->setAccessibleName(tr("Where the messages are kept"));
  place_->setReadOnly(true); // its path can be copied
  place_->setFrame(false);
  place_->hide();
  auto* all = new QWidget;
  auto* column = new QVBoxLayout(all);
  column->setContentsMargins(0, 0, 0, 0);
  column->addWidget(lines_);
  column->addWidget(place_);
  setWidget(all);
}

void MessageLog::add(const QString& sentence) {
  if (sentence.isEmpty()) return;
  lines_->appendPlainText(QTime::currentTime().toString("HH:mm:ss  ") + sentence);
  emit added(sentence);
}

void MessageLog::keepIn(LogFile& file) {
  connect(this, &MessageLog::added, &file, &LogFile::add);
  connect(&file, &LogFile::failed, place_, &QLineEdit::setText);
  connect(&file, &LogFile::failed, this, &MessageLog::say);
  place_->setText(tr("Also in %1").arg(file.path()));
  place_->setVisible(!file.path().isEmpty());
}

} // namespace palp
