#pragma once

#include "app/gui/document/ResultsMark.h"
#include "app/gui/project/Project.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <filesystem>
#include <functional>
#include <memory>
#include <set>

namespace palp {

class MainWindow;
class Workbench;
struct Leaving;

/// The project as a file of the user's, its samples and network in a folder next to it (NAME.palp): opens and saves
/// them, asks before unsaved work would be lost, and keeps the window's title.
class Document : public QObject {
  Q_OBJECT

public:
  Document(MainWindow& window, Workbench& workbench, NetworkSession& network);

  /// The project with the scene that is seen.
  [[nodiscard]] Project project() const;
  /// Something would be lost if the program ended now.
  [[nodiscard]] bool unsaved() const;
  /// Samples or networks would be.
  [[nodiscard]] bool resultsUnsaved() const;
  /// Nothing is unsaved and nothing ends by it, or the user has saved what is unsaved, or lets it go: one question
  /// about all.
  bool mayLeave(const Leaving& leaving);
  /// A file of ours: a design or a project in place of what is open (asks first), samples and networks in the Network
  /// scene. Where it cannot be opened, reports why and keeps the present project.
  void open(const QString& file);
  /// The same for several: all of them samples.
  void open(const QStringList& files);
  /// The same for files that the user chooses.
  void open();
  /// The project of the program's start is what this file holds; a design alone is kept in no file yet.
  void beganWith(const QString& file);
  /// The paper's design; asks first.
  void startAnew();
  /// A project that came with the program, as one that has no file yet; asks first. Reports why where it cannot be
  /// opened.
  void openExample(const QString& file, const QString& title);
  /// In its file, or in one that the user chooses. False where it was not saved.
  bool save();
  bool saveAs();
  /// What another window has left, as unsaved work on the project in `file` (empty: in none yet); `done` once it is
  /// open; where some of it cannot be, that is reported, and its argument is false. Undo leads to what the file
  /// holds, where it can be read. Throws Error.
  void recover(const QByteArray& project, const QString& file, const std::filesystem::path& results,
               const std::function<void(bool complete)>& done);
  /// Files that were opened or saved, the newest first.
  [[nodiscard]] static QStringList recent();

signals:
  void unsavedChanged();

private:
  void openProject(const QString& file);
  void openResults();
  void replaceByRecovered(const Project& recovered, const QString& file);
  bool mayReplace(const Project& next);
  /// As text; not empty.
  [[nodiscard]] QString unsavedWords() const;
  bool write(const QString& file);
  /// Waits until what was ordered to be saved is saved, or has failed.
  void finishWriting();
  /// Reports what could not be opened, and that it is kept.
  void sayProblems(const OpenedResults& opened);
  /// A file contains these samples and this network.
  void resultsSaved(const NetworkResults& results);
  void showTitle();

  MainWindow& window_;
  Workbench& workbench_;
  NetworkSession& network_;
  ResultsMark saved_;
  /// Of the files next to the project: whose content was opened or written here. Read by the writer; another project
  /// has another one.
  std::shared_ptr<std::set<std::filesystem::path>> ours_ = std::make_shared<std::set<std::filesystem::path>>();
  bool leaving_ = false; ///< the question is open, or its answer is being saved
};

} // namespace palp
