#include "app/gui/touch/StaleNote.h"

#include "app/gui/project/Workbench.h"

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
  if (nothing)
    setText(running ? tr("Being computed...") : tr("Not computed yet."));
  else
    setText(running ? tr("This is the result before; the new one is being computed...")
                    : tr("This is the result before; the new one is not computed."));
  adjustSize();
  move((parentWidget()->width() - width()) / 2, parentWidget()->height() - height() - 8);
}

} // namespace palp
