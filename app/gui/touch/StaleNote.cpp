#include "app/gui/touch/StaleNote.h"

#include "app/gui/project/Workbench.h"
#include "app/gui/project/changes/ProjectChange.h"

#include <QEvent>

namespace palp {

StaleNote::StaleNote(QWidget& over, Workbench& workbench) : QLabel(&over), workbench_(workbench) {
  setObjectName("staleNote");
  setProperty("role", "note");
  setAttribute(Qt::WA_TransparentForMouseEvents);
  hide();
  over.installEventFilter(this);
  connect(&workbench, &Workbench::projectChanged, this, &StaleNote::display);
  connect(&workbench.touch(), &TouchSession::changed, this, &StaleNote::display);
  connect(&workbench.touch().runner(), &JobRunner::started, this, &StaleNote::display);
  connect(&workbench.touch().runner(), &JobRunner::finished, this, &StaleNote::display);
  display();
}

bool StaleNote::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Resize || event->type() == QEvent::Show) display();
  return QLabel::eventFilter(watched, event);
}

void StaleNote::display() {
  TouchSession& touch = workbench_.touch();
  const bool nothing = touch.fields() == nullptr;
  setVisible(nothing || !touch.upToDate());
  if (isHidden()) return;
  const bool running = touch.runner().running();
  Project then = workbench_.project();
  then.design = touch.touch().design();
  then.load = touch.touch().load();
  then.mesh = touch.touch().meshOptions();
  if (touch.touch().path() != loadsAfter(then.load, then.path, then.design)) then.path.reset();
  const QString since = sinceWords(then, workbench_.project());
  const QString result = since.isEmpty() ? tr("Previous result") : tr("Previous result (%1)").arg(since);
  if (nothing)
    setText(running ? tr("Computing...") : tr("Not computed yet."));
  else
    setText(running ? tr("%1. Computing...").arg(result) : tr("%1. Not computed yet.").arg(result));
  adjustSize();
  move((parentWidget()->width() - width()) / 2, parentWidget()->height() - height() - 8);
}

} // namespace palp
