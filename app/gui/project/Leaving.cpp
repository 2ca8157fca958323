#include "app/gui/project/Leaving.h"

#include <QApplication>
#include <QMessageBox>

namespace palp {

QStringList LossQuestion::losses(const Leaving& leaving) const {
  QStringList all;
  for (const auto& [owner, answer] : answers_)
    if (owner != nullptr) all << answer(leaving);
  return all;
}

bool acceptsLosses(const QStringList& losses, QWidget* parent) {
  if (losses.isEmpty()) return true;
  QMessageBox question(QMessageBox::Question, QObject::tr("Continue?"),
                       losses.join("\n\n") + QObject::tr("\n\nContinue anyway?"), QMessageBox::Yes | QMessageBox::No,
                       parent != nullptr ? parent : QApplication::activeWindow());
  question.setObjectName("losses");
  question.setDefaultButton(QMessageBox::No);
  return question.exec() == QMessageBox::Yes;
}

} // namespace palp
