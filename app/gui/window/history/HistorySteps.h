#pragma once

#include "app/gui/project/Project.h"

#include <QObject>

#include <optional>

namespace palp {

class MainWindow;
class Workbench;

/// Nothing is undone or done again unseen: leads to the scene where the edit was made, unless the scene that is shown
/// shows the change too. Several steps together (a click in the history) count as one.
class HistorySteps : public QObject {
  Q_OBJECT

public:
  HistorySteps(MainWindow& window, Workbench& workbench);

private:
  void arrive();

  MainWindow& window_;
  Workbench& workbench_;
  std::optional<Project> from_; ///< before the steps that are made now
  QString scene_, sentence_;    ///< of the last one
};

} // namespace palp
