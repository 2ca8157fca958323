#pragma once

#include <QObject>

class QMenu;

namespace palp {

class MainWindow;
enum class Theme;

/// How the window looks: theme, size of the text, full screen, the side panel. What is chosen is kept in the user's
/// settings.
class ViewActions : public QObject {
  Q_OBJECT

public:
  /// Adds them to the menu.
  ViewActions(MainWindow& window, QMenu& menu);

private:
  void addTheme(QMenu& menu, const QString& text, const QString& tip, const QString& keys, const char* name,
                Theme theme);
  void addTextSize(QMenu& menu, const QString& text, const QString& tip, const QList<QKeySequence>& keys,
                   const char* name, int step);
  void addFullScreen(QMenu& menu);
  void addPanel(QMenu& menu);

  MainWindow& window_;
};

} // namespace palp
