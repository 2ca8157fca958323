#pragma once

#include <QObject>
#include <QString>
#include <QStringList>

namespace palp {

class MainWindow;
class Workbench;

/// The project as a file of the user's: opens and saves it, asks before unsaved work would be lost, and keeps the
/// window's title.
class Document : public QObject {
  Q_OBJECT

public:
  Document(MainWindow& window, Workbench& workbench);

  /// Nothing is unsaved, or the user has saved it or lets it go.
  bool mayLeave();
  /// A design or project file in place of what is open; asks first. Says why where it cannot be read, and keeps what
  /// was there.
  void open(const QString& file);
  /// The same for a file that the user chooses.
  void open();
  /// The paper's design; asks first.
  void startAnew();
  /// In its file, or in one that the user chooses. False where it was not saved.
  bool save();
  bool saveAs();
  /// Files that were opened or saved, the newest first.
  [[nodiscard]] static QStringList recent();

private:
  bool write(const QString& file);
  void showTitle();

  MainWindow& window_;
  Workbench& workbench_;
};

} // namespace palp
