#include "app/gui/document/Autosave.h"
#include "app/gui/document/Document.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapSpecs.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/window/SidePanel.h"
#include "app/study/Resources.h"
#include "app/study/live/LiveSource.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAbstractButton>
#include <QAbstractSpinBox>
#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QLineEdit>
#include <QListWidget>
#include <QMenu>
#include <QPushButton>
#include <QSlider>
#include <QTabBar>
#include <QTemporaryDir>
#include <QTimer>
#include <QToolButton>

#include <cstdlib>
#include <iostream>
#include <random>

namespace palp {
namespace {

/// Threads of this process; a job that is forgotten leaves its own.
int threads() {
  return static_cast<int>(QDir("/proc/self/task").entryList(QDir::Dirs | QDir::NoDotAndDotDot).size());
}

/// A user without a plan: clicks, drags, turns the wheel and types on whatever is there. The same seed does the same.
class Monkey {
public:
  Monkey(MainWindow& window, unsigned seed) : window_(window), random_(seed) {}

  void act() {
    switch (upTo(21)) {
    case 0:
      window_.showScene(window_.sceneNames()[upTo(static_cast<int>(window_.sceneNames().size()))]);
      break;
    case 1:
    case 2:
      clickOn(any<QAbstractButton>());
      break;
    case 3:
      if (auto* spin = any<QAbstractSpinBox>()) spin->stepBy(upTo(7) - 3);
      break;
    case 4:
      if (auto* slider = any<QSlider>())
        slider->setValue(slider->minimum() + upTo(slider->maximum() - slider->minimum() + 1));
      break;
    case 5:
      if (auto* box = any<QComboBox>()) QTest::keyClick(box, upTo(2) == 0 ? Qt::Key_Down : Qt::Key_Up);
      break;
    case 6:
      type();
      break;
    case 7:
      if (auto* tabs = any<QTabBar>()) tabs->setCurrentIndex(upTo(tabs->count()));
      break;
    case 8:
    case 9:
      if (auto* view = any<PictureView>()) drag(*view, placeIn(*view), placeIn(*view), modifiers());
      break;
    case 10:
      if (auto* view = any<PictureView>()) QTest::mouseClick(view, Qt::LeftButton, modifiers(), placeIn(*view));
      break;
    case 11:
      if (auto* view = any<PictureView>()) wheel(*view, 120 * (upTo(3) - 1));
      break;
    case 12:
      dragArrow();
      break;
    case 13:
      QTest::keyClick(&window_, upTo(2) == 0 ? Qt::Key_Z : Qt::Key_Y, Qt::ControlModifier);
      break;
    case 14:
      window_.setTheme(upTo(2) == 0 ? Theme::Light : Theme::Dark);
      break;
    case 15:
      if (upTo(4) == 0) QTest::keyClick(&window_, Qt::Key_Escape);
      if (upTo(8) == 0) window_.resize(900 + upTo(700), 600 + upTo(400));
      break;
    case 16:
      editElsewhere();
      break;
    case 17:
      letFall();
      break;
    case 18:
      tryToLeave();
      break;
    case 19:
      chooseLaw();
      break;
    case 20:
      drawPath();
      break;
    }
  }

private:
  int upTo(int n) { return static_cast<int>(random_() % static_cast<unsigned>(std::max(n, 1))); }
  QPoint placeIn(const QWidget& widget) { return {upTo(widget.width()), upTo(widget.height())}; }
  Qt::KeyboardModifiers modifiers() { return upTo(4) == 0 ? Qt::ShiftModifier : Qt::NoModifier; }

  /// One of the visible, usable widgets of the scene; null where there are none. Those that open a dialog, which would
  /// wait for an answer, begin another program, or make the work long are left alone.
  template <class Widget> Widget* any() {
    QList<Widget*> usable;
    for (Widget* widget : window_.currentScene().findChildren<Widget*>())
      if (widget->isVisible() && widget->isEnabled() && !asks(*widget)) usable << widget;
    return usable.isEmpty() ? nullptr : usable[upTo(static_cast<int>(usable.size()))];
  }
  static bool asks(const QWidget& widget) {
    const QStringList longer{"meshSize",   "automaticSize", "perArea",  "touchCount",
                             "sweepCount", "sweepSteps",    "mapPlaces"};
    if (longer.contains(widget.objectName()) || longer.contains(widget.parentWidget()->objectName())) return true;
    const auto* button = qobject_cast<const QAbstractButton*>(&widget);
    return button != nullptr && (button->text().contains("...") || button->objectName() == "runReport");
  }
  void clickOn(QAbstractButton* button) {
    if (button != nullptr) QTest::mouseClick(button, Qt::LeftButton, modifiers());
  }
  void type() {
    auto* edit = any<QLineEdit>();
    if (edit == nullptr) return;
    const QStringList words{"1", "-2.5", "0.4999", "abc", "", "1e9", "3, 4, 5", "all", "0,1", "99"};
    edit->setFocus();
    edit->selectAll();
    QTest::keyClicks(edit, words[upTo(static_cast<int>(words.size()))]);
    if (upTo(2) == 0) QTest::keyClick(edit, Qt::Key_Return);
  }
  /// Leaves a scene that may be computing, changes something on another one and comes back at once.
  void editElsewhere() {
    const QString here = window_.currentScene().objectName();
    window_.showScene("design");
    if (auto* edit = window_.currentScene().findChild<QLineEdit*>("block_mm[2]")) {
      edit->setFocus();
      edit->selectAll();
      QTest::keyClicks(edit, QString::number(5 + 0.1 * upTo(10)));
    }
    window_.showScene(here);
  }
  /// On the Design scene: the law, its read-out or a number of it.
  void chooseLaw() {
    window_.showScene("design");
    const std::array boxes{"resistance.law", "resistance.readout"};
    const std::array edits{"resistance.electrode_radius_mm", "resistance.wire_ohm", "resistance.contact_ohm_mm2"};
    if (auto* box = window_.currentScene().findChild<QComboBox*>(boxes[static_cast<std::size_t>(upTo(2))]);
        box != nullptr && box->isVisible())
      QTest::keyClick(box, upTo(2) == 0 ? Qt::Key_Down : Qt::Key_Up);
    auto* edit = window_.currentScene().findChild<QLineEdit*>(edits[static_cast<std::size_t>(upTo(3))]);
    if (edit == nullptr || !edit->isVisible()) return;
    edit->setFocus();
    edit->selectAll();
    QTest::keyClicks(edit, QString::number(0.1 * upTo(6)));
  }
  /// One of Palp's files, or none of them.
  void letFall() {
    const std::array files{resource("paper.json"), shippedNetwork(), resource("board/paper-samples.csv"),
                           resource("icons/palp.svg")};
    dropOn(window_, QString::fromStdString(files[static_cast<std::size_t>(upTo(4))].string()));
  }
  /// Asks for what would lose unsaved work; the question is then closed, which leaves all as it was.
  void tryToLeave() {
    if (!window_.document().unsaved()) return;
    if (upTo(2) == 0)
      EXPECT_FALSE(window_.close());
    else
      QTest::keyClick(&window_, Qt::Key_N, Qt::ControlModifier);
  }
  /// An indenter that is pressed and slid over the face.
  void drawPath() {
    auto* block = window_.currentScene().findChild<BlockView*>("block");
    auto* tool = window_.currentScene().findChild<QAbstractButton*>("clickIndenter");
    if (block == nullptr || tool == nullptr || !block->isVisible()) return;
    clickOn(tool);
    const QPoint place = block->placeOf({15, 15, 5}).toPoint();
    if (upTo(2) == 0) QTest::mouseClick(block, Qt::LeftButton, {}, place);
    drag(*block, place, place + QPoint(upTo(80) - 40, upTo(80) - 40), Qt::ControlModifier);
  }
  void dragArrow() {
    auto* block = window_.currentScene().findChild<BlockView*>("block");
    if (block == nullptr) return;
    if (const auto grip = block->gripOf(upTo(2))) drag(*block, grip->toPoint(), placeIn(*block), modifiers());
  }

  MainWindow& window_;
  std::mt19937 random_;
};

class MonkeyWindow : public WindowFixture {
protected:
  MonkeyWindow() {
    JobRunner& runner = workbench.touch().runner();
    QObject::connect(&runner, &JobRunner::started, &window, [this] { explained_ = false; });
    QObject::connect(&runner, &JobRunner::failed, &window, [this] { explained_ = true; });
    QObject::connect(&runner, &JobRunner::finished, &window, [this](bool cancelled) { explained_ |= cancelled; });
  }

  /// The pictures of a scene, by the views' names.
  static std::map<std::string, QImage> pictures(MainWindow& shown, const QString& scene) {
    shown.showScene(scene);
    QTest::qWait(150);
    std::map<std::string, QImage> all;
    for (auto* view : shown.currentScene().findChildren<PictureView*>()) {
      if (!view->isVisible()) continue;
      if (auto* block = qobject_cast<BlockView*>(view)) block->resetCamera();
      all[view->objectName().toStdString()] = view->image().copy();
    }
    return all;
  }

  /// Writes a picture to look at; the file's name.
  static std::string keep(const QImage& image, const std::string& name, const std::string& window) {
    const std::string file = QDir::temp().filePath("gui_monkey").toStdString() + "-" + name + "-" + window + ".png";
    return image.save(QString::fromStdString(file)) ? file : file + " (not written)";
  }

  bool quiet() { return !workbench.touch().runner().running() && !network.runner().running(); }
  /// What the status line says of the jobs that run.
  std::string running() {
    QStringList words;
    for (const auto* job : window.findChildren<QToolButton*>("jobWords"))
      if (job->isVisible()) words << job->text();
    return words.join("; ").toStdString();
  }

  /// What the scene shows is there, or being computed, or the window said why it is not.
  void expectNothingForgotten(int action) {
    const TouchSession& touch = workbench.touch();
    EXPECT_TRUE(!touch.missing() || !quiet() || explained_ || !touch.computable())
        << "nothing runs, was cancelled or failed, and the inputs are valid: what the scene shows is missing after "
           "action "
        << action;
  }

  /// What is drawn belongs to what is set, where nothing is being computed.
  void expectRightPicture(int action) {
    const TouchSession& touch = workbench.touch();
    const std::string where = "after action " + std::to_string(action);
    if (touch.missing()) return;   // cancelled, failed or refused: the window says so
    if (!touch.upToDate()) return; // changed while no scene needs it
    EXPECT_EQ(touch.touch().design(), workbench.project().design) << where;
    const Project& now = workbench.project();
    EXPECT_EQ(touch.touch().load(), now.load) << where;
    EXPECT_EQ(touch.touch().path(), loadsAfter(now.load, now.path, now.design)) << where;
    QApplication::processEvents();
    for (const char* name : {"heatmap", "resistanceHeatmap"}) {
      const auto& view = find<HeatmapView>(name);
      if (!view.isVisible() || touch.electrodes() == nullptr) continue;
      const ResistanceKind kind =
          std::string(name) == "heatmap" ? ResistanceKind::RelativeChange : workbench.project().view.resistance;
      if (kind == ResistanceKind::LessReference && workbench.comparable()) continue; // of two touches
      const auto resistances = workbench.resistances();
      if (!resistances) continue; // under the field they may have been stopped
      EXPECT_EQ(view.heatmap().values, resistanceHeatmap(*resistances, kind).values) << name << " " << where;
    }
    if (auto& slider = find<QSlider>("increments"); slider.isVisible()) {
      EXPECT_EQ(slider.value(), std::max(touch.place(), 0)) << where;
    }
    const NetworkSamples* samples = network.samples();
    EXPECT_TRUE(network.fit() == nullptr || samples != nullptr) << where;
    if (samples == nullptr || !network.upToDate()) return;
    EXPECT_EQ(samples->training.rowWires, workbench.project().design.rowWires()) << where;
  }

private:
  bool explained_ = false; ///< the last computation was cancelled or failed, and the window said so
};

/// Number of actions; more by the environment, for a longer night.
int actions() {
  const char* wanted = std::getenv("PALP_MONKEY_ACTIONS");
  return wanted != nullptr ? std::atoi(wanted) : 1000;
}

TEST_F(MonkeyWindow, SurvivesAThousandActionsAndShowsWhatAFreshWindowShows) {
  ASSERT_TRUE(solved());
  const char* wanted = std::getenv("PALP_MONKEY_SEED");
  const QTemporaryDir folder; // for the files that are written under whatever name was typed
  QDir::setCurrent(folder.path());
  const Autosave autosave(workbench, network, window, folder.filePath("recovery"));
  Monkey monkey(window, wanted != nullptr ? static_cast<unsigned>(std::atoi(wanted)) : 20130911u);
  // Whatever asks the user something is sent away.
  QTimer closer;
  QObject::connect(&closer, &QTimer::timeout, &closer, [] {
    if (auto* dialog = QApplication::activeModalWidget()) dialog->close();
    if (auto* popup = QApplication::activePopupWidget()) popup->close();
  });
  closer.start(20);
  for (int action = 0; action < actions(); ++action) {
    monkey.act();
    QApplication::processEvents();
    expectNothingForgotten(action);
    if (HasFailure()) return; // the first one says most
    if (action % 50 != 49) continue;
    // Each Escape stops what the scene computes and, where that is nothing, what the others do.
    for (int escapes = 0; escapes < 3 && !QTest::qWaitFor([&] { return !window.busy(); }, kPatience_ms / 12);
         ++escapes) {
      window.activateWindow(); // a menu that was closed takes the focus along on a platform without a window manager
      EXPECT_TRUE(QTest::qWaitForWindowActive(&window));
      QTest::keyClick(&window, Qt::Key_Escape);
    }
    ASSERT_TRUE(idle()) << "a job does not end after action " << action << ": " << running();
    expectNothingForgotten(action);
    expectRightPicture(action);
  }
  // Off the fields: one that is being edited keeps its words.
  window.setFocus();
  workbench.touch().cancel();
  network.cancel();
  ASSERT_TRUE(idle());
  const int resting = threads();

  // The same project in this window and in one that nobody has touched.
  Project project = quickProject();
  project.load.areas.push_back({4, {0.3, -0.2, -2.5}});
  project.view.quantity = Quantity::VonMises;
  workbench.replace(project);
  window.setTheme(Theme::Light);
  window.resize(1300, 800);
  for (auto* tabs : window.findChildren<QTabWidget*>()) tabs->setCurrentIndex(0);
  for (auto* panel : window.findChildren<SidePanel*>()) panel->setFolded(false);
  window.showScene("deformation");
  workbench.touch().resume();
  ASSERT_TRUE(solved());
  ASSERT_TRUE(idle());
  // The autosave may be writing; a job that is left behind stays.
  EXPECT_TRUE(QTest::qWaitFor([&] { return threads() <= resting; }, kPatience_ms)) << "no job is left behind";

  Workbench fresh(project);
  NetworkSession freshNetwork;
  MainWindow other(fresh, freshNetwork);
  other.setTheme(Theme::Light);
  for (auto* tabs : other.findChildren<QTabWidget*>()) tabs->setCurrentIndex(0);
  other.resize(1300, 800);
  other.show();
  ASSERT_TRUE(
      QTest::qWaitFor([&] { return fresh.touch().fields() != nullptr && fresh.touch().upToDate(); }, kPatience_ms));
  for (const char* scene : {"deformation", "resistance", "design"}) {
    const auto mine = pictures(window, scene);
    const auto its = pictures(other, scene);
    ASSERT_FALSE(its.empty()) << scene;
    for (const auto& [name, image] : its) {
      ASSERT_TRUE(mine.contains(name)) << scene << " " << name;
      ASSERT_EQ(mine.at(name).size(), image.size()) << scene << " " << name;
      EXPECT_TRUE(mine.at(name) == image)
          << "another picture on " << scene << ": " << name << ", " << keep(mine.at(name), name, "touched") << " and "
          << keep(image, name, "fresh");
    }
  }
}

} // namespace
} // namespace palp
