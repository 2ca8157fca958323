#include "app/gui/window/MessageLog.h"

#include <QPlainTextEdit>
#include <QTime>

namespace palp {

namespace {

constexpr int kMostLines = 1000; ///< of a session of days

} // namespace

MessageLog::MessageLog(QWidget* parent) : QDockWidget(tr("Messages"), parent) {
  setObjectName("messages");
  lines_ = new QPlainTextEdit;
  lines_->setObjectName("messageLines");
  lines_->setAccessibleName(tr("What the window has said"));
  lines_->setReadOnly(true);
  lines_->setMaximumBlockCount(kMostLines);
  setWidget(lines_);
}

void MessageLog::add(const QString& sentence) {
  if (!sentence.isEmpty()) lines_->appendPlainText(QTime::currentTime().toString("HH:mm:ss  ") + sentence);
}

} // namespace palp
