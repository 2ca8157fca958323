// The window's costs under software rendering: for each scene, in a process of its own, the time from exec to the first
// frame, the CPU time of a frame of 1500 x 840 pixels and the memory; for single views the CPU time of a frame.
// Usage: gui_benchmark [SCENE...]; without a display: QT_QPA_PLATFORM=offscreen.

#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapSpecs.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/window/Application.h"
#include "app/gui/window/MainWindow.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QFile>
#include <QLabel>
#include <QProcess>
#include <QStandardPaths>

#include <vtkNew.h>
#include <vtkRenderer.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <iostream>
#include <sys/resource.h>

namespace palp {
namespace {

constexpr int kWidth_px = 1500;
constexpr int kHeight_px = 840;
constexpr int kFrames = 40;
constexpr int kPatience_ms = 120000;

long long now_ns() {
  return std::chrono::steady_clock::now().time_since_epoch().count();
}

/// Of all threads: a software renderer draws in its own.
double cpu_ms() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& time) {
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

/// A line of /proc/self/status in MB: VmHWM (the most so far) or VmRSS.
double memory_MB(const QByteArray& line) {
  QFile status("/proc/self/status");
  if (!status.open(QIODevice::ReadOnly)) return 0;
  for (const QByteArray& each : status.readAll().split('\n'))
    if (each.startsWith(line)) return each.mid(line.size() + 1).trimmed().split(' ').front().toDouble() / 1024;
  return 0;
}

bool waitFor(const std::function<bool()>& condition) {
  QElapsedTimer clock;
  clock.start();
  while (!condition() && clock.elapsed() < kPatience_ms) QApplication::processEvents(QEventLoop::AllEvents, 20);
  return condition();
}

QList<PictureView*> visibleViews(const QWidget& root) {
  QList<PictureView*> views;
  for (auto* view : root.findChildren<PictureView*>())
    if (view->isVisible()) views << view;
  return views;
}

double cpuAFrame_ms(const QList<PictureView*>& views, const std::function<void(int)>& change = {}) {
  const auto draw = [&](int frame) {
    if (change) change(frame);
    for (PictureView* view : views) {
      view->invalidate();
      view->repaint();
    }
    QApplication::processEvents();
  };
  for (int frame = 0; frame < 3; ++frame) draw(frame); // the shaders are compiled with the first
  const double before = cpu_ms();
  for (int frame = 0; frame < kFrames; ++frame) draw(frame);
  return (cpu_ms() - before) / kFrames;
}

/// Prints one line about a scene.
int measureScene(const QString& name, long long start_ns) {
  Workbench workbench(exampleProject());
  NetworkSession network;
  MainWindow window(workbench, network);
  window.resize(kWidth_px, kHeight_px);
  if (!window.showScene(name)) return 2;
  window.show();
  const bool drawn = waitFor([&] {
    const QList<PictureView*> views = visibleViews(window.currentScene());
    return std::all_of(views.begin(), views.end(), [](const PictureView* view) { return view->renderCount() > 0; });
  });
  const double first_s = 1e-9 * static_cast<double>(now_ns() - start_ns);
  const bool complete = waitFor([&] {
    return window.currentScene().complete() && !workbench.touch().runner().running() && !network.runner().running();
  });
  QApplication::processEvents();
  const double frame_ms = cpuAFrame_ms(visibleViews(window.currentScene()));
  const double most_MB = memory_MB("VmHWM"), now_MB = memory_MB("VmRSS");
  workbench.touch().rest(); // as the window does when nothing was computed for a while
  std::printf("%-12s first frame %.2f s   all views a frame  %5.1f ms CPU   memory %4.0f MB, at most %4.0f MB, "
              "at rest %4.0f MB%s\n",
              name.toUtf8().constData(), first_s, frame_ms, now_MB, most_MB, memory_MB("VmRSS"),
              drawn && complete ? "" : "   (never complete)");
  return 0;
}

/// What the machine itself needs, for it changes from hour to hour: VTK clears an empty window that is read back and
/// painted, and a picture that is there is painted.
void measureYardsticks(const std::function<void(QWidget&)>& show) {
  vtkNew<vtkRenderer> nothing;
  VtkView empty(nothing, nullptr);
  show(empty);
  std::printf("yardstick: empty window of VTK     %5.1f ms CPU\n", cpuAFrame_ms({&empty}));
  QLabel picture;
  QPixmap pixels(kWidth_px, kHeight_px);
  pixels.fill(Qt::white);
  picture.setPixmap(pixels);
  show(picture);
  std::printf("yardstick: a picture painted       %5.1f ms CPU\n", cpuAFrame_ms({}, [&](int) { picture.repaint(); }));
}

/// Prints a line a view, each alone at full size.
int measureViews() {
  Touch touch(paperDesign(), exampleProject().load);
  touch.advance(Stage::Resistances);
  const NodalFields fields = touch.problem()->fields(touch.solution()->state());
  const auto show = [](QWidget& view) {
    view.resize(kWidth_px, kHeight_px);
    view.show();
    QApplication::processEvents();
  };
  // Before all others: the first in a process has its shaders compiled, the second finds them.
  const auto showTimed = [&](const char* what, QWidget& view) {
    const long long start_ns = now_ns();
    show(view);
    std::printf("first drawing of %-17s %5.0f ms\n", what, 1e-6 * static_cast<double>(now_ns() - start_ns));
    view.hide();
  };
  const DeformationState state{&touch.design(), touch.mesh(), &fields, touch.displacements(), &touch.load(), 1};
  for (int time = 0; time < 2; ++time) {
    BlockView block;
    block.show(state, {}, true);
    showTimed("a block", block);
    ChartView chart;
    ChartSpec curve;
    curve.series.push_back({"curve", {0, 1, 2}, {1, 3, 2}});
    chart.setChart(curve);
    showTimed("a chart", chart);
    HeatmapView heatmap;
    heatmap.setHeatmap(resistanceHeatmap(touch.design(), *touch.displacements(), ResistanceKind::RelativeChange));
    showTimed("a heatmap", heatmap);
  }
  measureYardsticks(show);
  const TouchResistances resistances = *resistancesOf(touch.design(), *touch.displacements());
  HeatmapView heatmap;
  show(heatmap);
  std::printf("heatmap alone, new values a frame  %5.1f ms CPU\n", cpuAFrame_ms({&heatmap}, [&](int frame) {
                heatmap.setHeatmap(resistanceHeatmap({resistances.rest_ohm, (1 + 1e-4 * frame) * resistances.now_ohm},
                                                     ResistanceKind::RelativeChange));
              }));
  heatmap.hide();
  BlockView block;
  block.show(state, {}, true);
  show(block);
  std::printf("block alone, turned                %5.1f ms CPU\n", cpuAFrame_ms({&block}, [&](int frame) {
                block.lookAlong({0.45, 1.0, -0.75 - 0.01 * frame});
              }));
  std::printf("block alone, warped anew a frame   %5.1f ms CPU\n", cpuAFrame_ms({&block}, [&](int frame) {
                DeformationOptions options;
                options.deformationScale = 1 + frame;
                block.show(state, options, false);
              }));
  return 0;
}

} // namespace
} // namespace palp

int main(int argc, char** argv) {
  palp::Application application(argc, argv);
  QApplication::setOrganizationName("palp-tests");
  QApplication::setApplicationName("palp-gui-benchmark");
  QStandardPaths::setTestModeEnabled(true);
  QStringList words = QApplication::arguments().mid(1);
  if (words.size() == 3 && words[0] == "--measure") return palp::measureScene(words[1], words[2].toLongLong());
  if (words == QStringList{"--views"}) return palp::measureViews();
  if (words.isEmpty()) {
    palp::Workbench workbench{palp::Project{}};
    palp::NetworkSession network;
    words = palp::MainWindow(workbench, network).sceneNames();
  }
  std::cout << "Software rendering, " << palp::kWidth_px << " x " << palp::kHeight_px << " pixels\n" << std::flush;
  const auto run = [](const QStringList& arguments) {
    QProcess child;
    child.setProcessChannelMode(QProcess::ForwardedChannels);
    child.start(QApplication::applicationFilePath(), arguments);
    child.waitForFinished(-1);
    return child.exitCode();
  };
  for (const QString& scene : words)
    if (run({"--measure", scene, QString::number(palp::now_ns())}) != 0) return 1;
  return run({"--views"});
}
