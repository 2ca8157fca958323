#pragma once

#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/views/PictureView.h"
#include "app/gui/window/MainWindow.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QDropEvent>
#include <QFileDialog>
#include <QLineEdit>
#include <QMimeData>
#include <QSettings>
#include <QTest>
#include <QTimer>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <algorithm>

namespace palp {

/// Generous: the machine may be busy with other tests.
constexpr int kPatience_ms = 60000;

/// A coarse mesh, so that the tests are about the window.
inline Project quickProject() {
  Project project = exampleProject();
  project.mesh.mapped = {9, 8, 2};
  project.samples.perArea = project.view.reportPerArea = 6;
  project.network.sweepCount = 3;
  return project;
}

/// The whole window on a quick project, shown.
class WindowFixture : public testing::Test {
protected:
  WindowFixture() {
    QSettings().clear(); // of the windows of other tests
    window.resize(1300, 800);
    window.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&window));
  }
  bool idle() {
    return QTest::qWaitFor([&] { return !window.busy(); }, kPatience_ms);
  }
  bool solved() {
    return QTest::qWaitFor([&] { return workbench.touch().fields() != nullptr && workbench.touch().upToDate(); },
                           kPatience_ms);
  }
  template <class Widget> Widget& find(const char* name) {
    auto* widget = window.findChild<Widget*>(name);
    EXPECT_NE(widget, nullptr) << name;
    return *widget;
  }
  /// By the keyboard, as a user would.
  void setNumber(const char* name, double value) {
    auto& box = find<QDoubleSpinBox>(name);
    box.setFocus();
    box.selectAll();
    QTest::keyClicks(&box, QString::number(value));
    QTest::keyClick(&box, Qt::Key_Return);
  }
  void choose(const char* name, int k) {
    auto& box = find<QComboBox>(name);
    box.setFocus();
    for (int step = 0; box.currentIndex() != k && step < 20; ++step)
      QTest::keyClick(&box, box.currentIndex() < k ? Qt::Key_Down : Qt::Key_Up);
  }
  /// What was asked for has been drawn, as whoever clicks at it sees: a view's first drawing waits for a free pass of
  /// the event loop, which a busy machine may not have for long.
  void settle() {
    QTest::qWait(80);
    const auto drawn = [&] {
      const auto views = window.findChildren<PictureView*>();
      return std::none_of(views.begin(), views.end(), [](const PictureView* view) {
        return !view->visibleRegion().isEmpty() && view->renderCount() == 0;
      });
    };
    EXPECT_TRUE(QTest::qWaitFor(drawn, kPatience_ms));
  }

  Workbench workbench{quickProject()};
  NetworkSession network;
  MainWindow window{workbench, network};
};

/// Answers the next file dialog with this file, as a user would.
inline void answerFileDialog(const QString& file) {
  QApplication::setAttribute(Qt::AA_DontUseNativeDialogs);
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, file] {
    auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
    if (dialog == nullptr) return;
    timer->stop();
    timer->deleteLater();
    dialog->findChild<QLineEdit*>("fileNameEdit")->setText(file);
    QTest::keyClick(dialog, Qt::Key_Return);
  });
  timer->start(20);
}

/// Lets a file fall on the window.
inline void dropOn(MainWindow& window, const QString& file) {
  QMimeData mime;
  mime.setUrls({QUrl::fromLocalFile(file)});
  QDropEvent event({10, 10}, Qt::CopyAction, &mime, Qt::LeftButton, {});
  static_cast<QObject&>(window).event(&event); // Qt's own way needs a drag that began outside
}

inline void drag(QWidget& widget, QPoint from, QPoint to, Qt::KeyboardModifiers modifiers = {}) {
  QTest::mousePress(&widget, Qt::LeftButton, modifiers, from);
  for (int k = 1; k <= 5; ++k) {
    const QPoint place = from + (to - from) * k / 5;
    QMouseEvent move(QEvent::MouseMove, place, widget.mapToGlobal(place), Qt::NoButton, Qt::LeftButton, modifiers);
    QApplication::sendEvent(&widget, &move);
  }
  QTest::mouseRelease(&widget, Qt::LeftButton, modifiers, to);
}

inline void wheel(QWidget& widget, int angle) {
  const QPointF place = widget.rect().center();
  QWheelEvent event(place, widget.mapToGlobal(place), {}, {0, angle}, Qt::NoButton, {}, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&widget, &event);
}

} // namespace palp
