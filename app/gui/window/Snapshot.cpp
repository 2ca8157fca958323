#include "app/gui/window/Snapshot.h"

#include "app/gui/project/Workbench.h"
#include "app/gui/views/PictureView.h"
#include "app/gui/window/MainWindow.h"

#include <QApplication>
#include <QTimer>

#include <iostream>

namespace palp {

namespace {

constexpr int kLookAgain_ms = 50;
constexpr int kQuietLooks = 3; ///< so that what came last is laid out as well

} // namespace

void snapshotWhenComplete(MainWindow& window, Workbench& workbench, const QString& file) {
  auto* timer = new QTimer(&window);
  QObject::connect(&workbench.touch().runner(), &JobRunner::failed, &window, [](const QString& sentence) {
    std::cerr << "palp-studio: " << sentence.toStdString() << "\n";
    QApplication::exit(1);
  });
  QObject::connect(timer, &QTimer::timeout, &window, [&window, file, timer, quiet = 0]() mutable {
    quiet = window.busy() || !window.currentScene().complete() ? 0 : quiet + 1;
    if (quiet < kQuietLooks) return;
    timer->stop();
    if (windowPicture(window).save(file, "PNG")) {
      QApplication::exit(0);
    } else {
      std::cerr << "palp-studio: " << file.toStdString()
                << ": cannot be written; allowed is a file in a folder that exists and may be written to\n";
      QApplication::exit(1);
    }
  });
  timer->start(kLookAgain_ms);
}

} // namespace palp
