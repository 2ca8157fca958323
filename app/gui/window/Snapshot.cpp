#include "app/gui/window/Snapshot.h"

#include "app/gui/project/Workbench.h"
#include "app/gui/views/PictureView.h"
#include "app/gui/widgets/Png.h"
#include "app/gui/window/MainWindow.h"
#include "io/AtomicFile.h"
#include "model/base/Error.h"

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
    try {
      writeFile(file.toStdString(), pngOf(windowPicture(window)).toStdString(), true);
      QApplication::exit(0);
    } catch (const Error& error) {
      std::cerr << "palp-studio: " << error.what() << '\n';
      QApplication::exit(1);
    }
  });
  timer->start(kLookAgain_ms);
}

} // namespace palp
