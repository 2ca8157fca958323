#include "app/gui/window/history/UndoActions.h"

#include "app/gui/project/Workbench.h"

#include <QAction>
#include <QApplication>
#include <QDoubleSpinBox>
#include <QKeyEvent>
#include <QLineEdit>
#include <QSpinBox>

namespace palp {

namespace {

/// What the box would show of its value.
QString shown(const QDoubleSpinBox& box) {
  return box.prefix() + box.textFromValue(box.value()) + box.suffix();
}
QString shown(const QSpinBox& box) {
  return box.prefix() + QString::number(box.value()) + box.suffix();
}

/// Puts back text in a box that it has not taken as its value; false where there is none.
template <class Box> bool dropsTyping(QWidget* focused) {
  auto* box = qobject_cast<Box*>(focused);
  auto* edit = box == nullptr ? nullptr : box->template findChild<QLineEdit*>();
  if (edit == nullptr || edit->text() == shown(*box) || edit->text() == box->specialValueText()) return false;
  edit->setText(shown(*box));
  return true;
}

} // namespace

UndoActions::UndoActions(Workbench& workbench, QObject* parent) : QObject(parent), workbench_(workbench) {
  QUndoStack& history = workbench.history();
  undo_ = new QAction(this);
  undo_->setObjectName("undo");
  undo_->setShortcut(QKeySequence::Undo);
  connect(undo_, &QAction::triggered, this, &UndoActions::stepBack);
  const auto nameUndo = [this](const QString& what) {
    undo_->setText(what.isEmpty() ? tr("Undo") : tr("Undo: %1").arg(what));
  };
  connect(&history, &QUndoStack::undoTextChanged, undo_, nameUndo);
  nameUndo({});
  redo_ = history.createRedoAction(this, tr("Redo"));
  redo_->setObjectName("redo");
  redo_->setShortcuts({QKeySequence("Ctrl+Y"), QKeySequence("Ctrl+Shift+Z")});
  qApp->installEventFilter(this);
  // An edit ends where the focus goes elsewhere: what is then typed is another one.
  connect(qApp, &QApplication::focusChanged, this, [this] { workbench_.closeEntry(); });
}

bool UndoActions::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::ShortcutOverride) return QObject::eventFilter(watched, event);
  const auto& key = static_cast<const QKeyEvent&>(*event);
  const QKeySequence keys(key.keyCombination());
  const bool ours = keys == undo_->shortcut() || redo_->shortcuts().contains(keys);
  if (!ours || QApplication::activeModalWidget() != nullptr) return QObject::eventFilter(watched, event);
  event->ignore(); // so that the shortcut is looked up and not the box's own
  return true;
}

void UndoActions::stepBack() {
  QWidget* focused = QApplication::focusWidget();
  if (dropsTyping<QDoubleSpinBox>(focused) || dropsTyping<QSpinBox>(focused)) return;
  if (focused != nullptr && focused->property("unapplied").toBool()) {
    workbench_.showAgain();
    return;
  }
  workbench_.closeEntry();
  workbench_.history().undo();
}

} // namespace palp
