#pragma once

#include "app/gui/document/ResultsMark.h"
#include "app/gui/jobs/JobRunner.h"

#include <QDateTime>
#include <QLockFile>
#include <QObject>
#include <QString>
#include <QTimer>

#include <memory>
#include <vector>

namespace palp {

class Document;
class Workbench;

/// What a window that did not end well has left in a folder.
struct LeftWork {
  QString folder;
  QString file; ///< the project's; empty where it had none
  QDateTime saved;
};

/// Keeps what is not saved in a folder of its own, some seconds old at most, while the window is open: the project, the
/// samples and the network. A window that ends as it should leaves nothing. Recordings need no copy: they grow in their
/// place (resources/docs/formats.md).
class Autosave : public QObject {
  Q_OBJECT

public:
  /// Keeps in a new folder below `root`, which is made. Throws Error.
  Autosave(Workbench& workbench, NetworkSession& network, Document& document, const QString& root,
           QObject* parent = nullptr);
  ~Autosave() override;

  /// Where the program keeps it: a folder of the user's.
  static QString standardRoot();
  /// Of windows that are gone; the newest first.
  static std::vector<LeftWork> left(const QString& root);
  /// The text of the project that was left. Throws Error.
  static QByteArray project(const LeftWork& work);
  /// The folder of its samples and network, which may be missing.
  static QString results(const LeftWork& work);
  static void forget(const LeftWork& work);

signals:
  /// Nothing can be kept any more; why.
  void failed(const QString& sentence);

private:
  void changed();
  void keep();
  void keepResults();
  void drop();
  void say(const QString& reason);

  Workbench& workbench_;
  NetworkSession& network_;
  Document& document_;
  QString folder_;
  std::unique_ptr<QLockFile> lock_;
  QTimer timer_;
  JobRunner runner_;
  QByteArray kept_; ///< text of the project as it lies in the folder
  ResultsMark keptResults_;
};

} // namespace palp
