#pragma once

#include "app/gui/jobs/ExportJob.h"

#include <QObject>
#include <QString>

#include <functional>

class QAction;
class QKeySequence;
class QMenu;

namespace palp {

class Document;
class MainWindow;
class Workbench;

/// File, Edit, View and Help of the window, with their shortcuts.
class Menus : public QObject {
  Q_OBJECT

public:
  Menus(MainWindow& window, Workbench& workbench, Document& document);

private:
  void buildFile();
  void buildExport(QMenu& menu);
  void buildEdit();
  void buildView();
  void buildHelp();
  QAction* add(QMenu& menu, const QString& text, const QString& tip, const QKeySequence& keys,
               const std::function<void()>& act);
  void makeFilm();
  void exportResistances();
  void saveView();
  void listRecent();
  [[nodiscard]] ExportJob::Making vtuMaking() const;
  /// Asks for a file, lets `write` write it and reports the outcome.
  void exportTo(const QString& title, const QString& proposal, const QString& filter,
                const std::function<void(const QString&)>& write);

  MainWindow& window_;
  Workbench& workbench_;
  Document& document_;
  QMenu* recent_ = nullptr;
};

} // namespace palp
