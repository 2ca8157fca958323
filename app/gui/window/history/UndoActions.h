#pragma once

#include <QObject>

class QAction;

namespace palp {

class Workbench;

/// Undo and redo of the project's history, wherever the focus is: boxes and fields would keep the keys for themselves.
/// What is typed and not applied yet goes first.
class UndoActions : public QObject {
  Q_OBJECT

public:
  UndoActions(Workbench& workbench, QObject* parent);

  [[nodiscard]] QAction* undo() const { return undo_; }
  [[nodiscard]] QAction* redo() const { return redo_; }

protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

private:
  void stepBack();

  Workbench& workbench_;
  QAction* undo_ = nullptr;
  QAction* redo_ = nullptr;
};

} // namespace palp
