#include "app/gui/window/ViewActions.h"

#include "app/gui/window/MainWindow.h"
#include "app/gui/window/SidePanel.h"
#include "app/gui/window/Style.h"

#include <QAction>
#include <QApplication>
#include <QDockWidget>
#include <QMenu>
#include <QSettings>

#include <algorithm>

namespace palp {

namespace {

QAction* action(QMenu& menu, const QString& text, const QString& tip, const QList<QKeySequence>& keys,
                const char* name) {
  QAction* added = menu.addAction(text);
  added->setObjectName(name);
  added->setStatusTip(tip);
  added->setShortcuts(keys);
  return added;
}

} // namespace

ViewActions::ViewActions(MainWindow& window, QMenu& menu) : QObject(&window), window_(window) {
  addTheme(menu, tr("&Dark theme"), tr("Switches between the light and the dark theme"), "Ctrl+T", "darkTheme",
           Theme::Dark);
  addTheme(menu, tr("&High contrast"), tr("Shows white and bright colours on black"), "Ctrl+Shift+T", "contrastTheme",
           Theme::Contrast);
  addTextSize(menu, tr("&Larger text"), tr("Makes all text larger"), {QKeySequence("Ctrl++"), QKeySequence("Ctrl+=")},
              "largerText", 1);
  addTextSize(menu, tr("&Smaller text"), tr("Makes all text smaller"), {QKeySequence("Ctrl+-")}, "smallerText", -1);
  addTextSize(menu, tr("&Normal text"), tr("Uses the desktop's text size"), {QKeySequence("Ctrl+0")}, "normalText", 0);
  addFullScreen(menu);
  addPanel(menu);
  menu.addAction(window_.findChild<QDockWidget*>("messages")->toggleViewAction());
}

void ViewActions::addTheme(QMenu& menu, const QString& text, const QString& tip, const QString& keys, const char* name,
                           Theme theme) {
  QAction* added = action(menu, text, tip, {QKeySequence(keys)}, name);
  added->setCheckable(true);
  connect(&menu, &QMenu::aboutToShow, added, [this, added, theme] { added->setChecked(window_.theme() == theme); });
  connect(added, &QAction::triggered, this, [this, theme] {
    window_.setTheme(window_.theme() == theme ? Theme::Light : theme);
    QSettings().setValue("theme", QString::fromStdString(kThemes.name(window_.theme())));
  });
}

void ViewActions::addTextSize(QMenu& menu, const QString& text, const QString& tip, const QList<QKeySequence>& keys,
                              const char* name, int step) {
  connect(action(menu, text, tip, keys, name), &QAction::triggered, this, [this, step] {
    const int wanted = step == 0 ? 100 : textPercent() + 10 * step;
    setTextPercent(std::clamp(wanted, kSmallestText_percent, kLargestText_percent));
    window_.setTheme(window_.theme());
    window_.showMessage(tr("Text at %1 %.").arg(textPercent()));
  });
}

void ViewActions::addFullScreen(QMenu& menu) {
  QAction* full = action(menu, tr("&Full screen"), tr("Switches between full screen and a window"),
                         {QKeySequence("F11")}, "fullScreen");
  full->setCheckable(true);
  connect(&menu, &QMenu::aboutToShow, full, [this, full] { full->setChecked(window_.isFullScreen()); });
  connect(full, &QAction::triggered, this,
          [this] { window_.setWindowState(window_.windowState() ^ Qt::WindowFullScreen); });
}

void ViewActions::addPanel(QMenu& menu) {
  QAction* panel =
      action(menu, tr("Side &panel"), tr("Shows or hides the scene's panel"), {QKeySequence("F9")}, "sidePanelShown");
  panel->setCheckable(true);
  const auto its = [this]() -> SidePanel* { // of several boards that of the one with the focus
    const QList<SidePanel*> panels = window_.currentScene().findChildren<SidePanel*>();
    const QWidget* focus = QApplication::focusWidget();
    for (SidePanel* each : panels)
      if (each->parentWidget() == focus || each->parentWidget()->isAncestorOf(focus)) return each;
    return panels.isEmpty() ? nullptr : panels[0];
  };
  connect(&menu, &QMenu::aboutToShow, panel, [panel, its] {
    panel->setEnabled(its() != nullptr);
    panel->setChecked(its() != nullptr && !its()->folded());
  });
  connect(&menu, &QMenu::aboutToHide, panel, [panel] { panel->setEnabled(true); }); // its key works in every scene
  connect(panel, &QAction::triggered, this, [this, its] {
    if (its() != nullptr)
      its()->setFolded(!its()->folded());
    else
      window_.showMessage(tr("This scene has no panel."));
  });
}

} // namespace palp
