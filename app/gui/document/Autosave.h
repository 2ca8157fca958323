#pragma once

#include "app/gui/document/ResultsMark.h"
#include "app/gui/jobs/JobRunner.h"

#include <QDateTime>
#include <QLockFile>
#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace palp {

class Document;
class MainWindow;
class Workbench;

/// What a window that did not end well has left in a folder. No other window takes it while one holds its lock.
struct LeftWork {
  QString folder;
  bool project = false;   ///< there is one that was not saved
  QString file;           ///< the project's own; empty where it had none
  QDateTime saved;        ///< when it was kept
  QStringList recordings; ///< files that were being recorded
  std::shared_ptr<QLockFile> lock;
};

/// Keeps what is not saved in a folder of its own, some seconds old at most, while the window is open: the project, the
/// samples and the network, and the names of the files that are being recorded, which grow in their place
/// (resources/docs/formats.md). Each project has a new folder; a window that ends as it should leaves none. Where
/// nothing can be saved, that is reported, and tried again at the next change.
class Autosave : public QObject {
  Q_OBJECT

public:
  /// Keeps in new folders below `root`, which is made.
  Autosave(Workbench& workbench, NetworkSession& network, MainWindow& window, const QString& root,
           QObject* parent = nullptr);
  ~Autosave() override;

  /// Where the program keeps it: a folder of the user's.
  static QString standardRoot();
  /// Of windows that are gone, the newest first; locked as long as they are held here.
  static std::vector<LeftWork> left(const QString& root);
  /// The text of the project that was left. Throws Error.
  static QByteArray project(const LeftWork& work);
  /// The folder of its samples and network, which may be missing.
  static QString results(const LeftWork& work);
  static void forget(const LeftWork& work);
  static void forgetRecordings(const LeftWork& work);

  /// Of work that is open in this window: its copy is this window's from now on, so that there is one at any time.
  void takeOver(const LeftWork& work);
  /// Of work that could be opened in part: its copy stays, and is not offered while this window is open.
  void hold(const LeftWork& work) { held_.push_back(work); }

signals:
  /// Nothing can be kept any more; why.
  void failed(const QString& sentence);

private:
  void changed();
  void keep();
  void keepProject();
  void keepResults();
  void keepRecordings();
  void drop();
  void makeFolder();
  void leaveFolder();
  void attempt(const std::function<void()>& act);
  void say(const QString& reason);
  [[nodiscard]] std::filesystem::path at(const char* name) const;

  Workbench& workbench_;
  NetworkSession& network_;
  Document& document_;
  QString root_, folder_;
  std::shared_ptr<QLockFile> lock_; ///< of the folder; null: there is none
  std::vector<LeftWork> left_;      ///< folders of projects before, which are being removed
  std::vector<LeftWork> held_;
  QStringList recordings_;
  QString said_; ///< why nothing could be kept the last time
  QTimer timer_;
  std::unique_ptr<JobRunner> runner_;
  QByteArray kept_; ///< text of the project as it lies in the folder
  ResultsMark keptResults_;
};

} // namespace palp
