#pragma once

#include "app/gui/touch/FilmDialog.h"
#include "app/gui/window/Scene.h"

#include <QMainWindow>

#include <filesystem>
#include <vector>

class QListWidget;
class QStackedWidget;

namespace palp {

class DeformationPage;
class Document;
class ExportJob;
class LiveBoards;
class LoadPathAnimation;
struct Leaving;
class MessageLog;
class NetworkPage;
class NetworkSession;
class ReportsPage;
class SceneExport;
class StatusLamps;
class Workbench;

/// Composes: a rail with the scenes, the scenes, the menus and the jobs' progress.
class MainWindow : public QMainWindow {
  Q_OBJECT

public:
  MainWindow(Workbench& workbench, NetworkSession& network);

  /// By its name on the command line. False where there is no such scene.
  bool showScene(const QString& name);
  /// The form of a study in the Reports scene. Throws Error where the file is none.
  void showStudy(const QString& file);
  /// In the Network scene.
  void openSamples(const std::vector<std::filesystem::path>& files);
  /// A dialog imports tables of measured data, one perhaps with its map, and opens the samples.
  void importTables(const QStringList& files);
  /// The same for tables that the user chooses.
  void chooseTables();
  [[nodiscard]] QStringList sceneNames() const;
  [[nodiscard]] Scene& currentScene() const;
  /// As the rail names it.
  [[nodiscard]] QString sceneTitle() const;
  [[nodiscard]] const DeformationPage& deformation() const { return *deformation_; }
  [[nodiscard]] Document& document() const { return *document_; }
  [[nodiscard]] ExportJob& exports() const { return *exports_; }
  [[nodiscard]] SceneExport& sceneExport() const { return *sceneExport_; }
  void setTheme(Theme theme);
  [[nodiscard]] Theme theme() const { return theme_; }
  /// Some background work runs.
  [[nodiscard]] bool busy() const;
  /// Size of the view that a film shows.
  [[nodiscard]] QSize filmedSize() const;
  /// Draws the load path into a GIF or a folder; reports why where it cannot.
  void animate(const QString& path, const FilmSettings& film);
  /// Shows a sentence in the status line, and keeps it in the log of messages.
  void showMessage(const QString& sentence);

signals:
  /// The files that are being recorded now.
  void recordingsChanged(const QStringList& files);

protected:
  void showEvent(QShowEvent* event) override;
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;

private:
  void addScene(const QString& name, const QString& title, const QString& tip, Scene* scene);
  void buildStatusLine();
  /// What the scene that is seen does; where it does nothing, what all do.
  void cancelAll();
  /// What runs and would end, a sentence each.
  [[nodiscard]] QStringList losses(const Leaving& leaving) const;
  /// What only scenes need that are not seen.
  void releaseMemory();
  void sceneChosen(int index);
  void restoreLayout();

  Workbench& workbench_;
  NetworkSession& network_;
  DeformationPage* deformation_ = nullptr;
  LoadPathAnimation* animation_ = nullptr;
  LiveBoards* live_ = nullptr;
  NetworkPage* networkPage_ = nullptr;
  ReportsPage* reports_ = nullptr;
  StatusLamps* lamps_ = nullptr;
  Document* document_ = nullptr;
  ExportJob* exports_ = nullptr;
  SceneExport* sceneExport_ = nullptr;
  MessageLog* log_ = nullptr;
  QListWidget* rail_ = nullptr;
  QStackedWidget* scenes_ = nullptr;
  QStringList names_;
  Theme theme_ = Theme::Light;
};

} // namespace palp
