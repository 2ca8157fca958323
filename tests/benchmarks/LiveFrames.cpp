// What a frame of the Live scene costs at 1500 x 840, all threads and the software renderer together, and what the
// heatmap costs alone. Needs no display.

#include "app/gui/live/LivePage.h"
#include "app/gui/live/LiveView.h"
#include "app/gui/views/HeatmapView.h"
#include "app/gui/window/Application.h"

#include <sys/resource.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QEventLoop>
#include <QTimer>

#include <cstdio>
#include <cstdlib>

namespace {

using namespace palp;

double cpu_ms() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto ms = [](const timeval& t) {
    return 1e3 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_usec);
  };
  return ms(usage.ru_utime) + ms(usage.ru_stime);
}

void spin(int duration_ms) {
  QEventLoop loop;
  QTimer::singleShot(duration_ms, &loop, &QEventLoop::quit);
  loop.exec();
}

void page(int seconds) {
  Workbench workbench(exampleProject());
  LivePage live(workbench, {[] { return std::vector<HidBoard>{}; }, [](const std::string&) { return nullptr; }});
  live.resize(1500, 840);
  live.show();
  spin(2000);
  auto* block = live.findChild<LiveView*>("liveBlock");
  auto* heatmap = live.findChild<HeatmapView*>("liveHeatmap");
  const int looks = live.looks(), blocks = block->renderCount(), heatmaps = heatmap->renderCount();
  QElapsedTimer clock;
  clock.start();
  const double before_ms = cpu_ms();
  spin(1000 * seconds);
  const double spent_ms = cpu_ms() - before_ms;
  const int frames = live.looks() - looks;
  std::printf(
      "live scene, 1500 x 840, touch moving: %.1f ms CPU a frame (%d frames in %.1f s, %.1f a second; %d of the "
      "block and %d of the heatmap rendered; with the board at 1000 reports/s and the decoding)\n",
      spent_ms / frames, frames, 1e-3 * static_cast<double>(clock.elapsed()),
      1e3 * frames / static_cast<double>(clock.elapsed()), block->renderCount() - blocks,
      heatmap->renderCount() - heatmaps);
  live.hide();
  spin(300);
  const double hidden_ms = cpu_ms();
  spin(2000);
  std::printf("hidden: %.1f %% of a core\n", (cpu_ms() - hidden_ms) / 20);
}

void heatmapAlone(int frames) {
  HeatmapView view;
  view.resize(760, 420);
  view.show();
  HeatmapSpec spec;
  spec.title = "dR/R";
  spec.colors = {ColorMap::Diverging, -1, 1, "dR/R", "%"};
  const auto draw = [&](int k) {
    spec.values = Eigen::MatrixXd::Random(10, 30) * (1 + 0.001 * k);
    view.setHeatmap(spec);
    return view.image().width(); // drawn for it
  };
  for (int k = 0; k < 10; ++k) draw(k);
  const double before_ms = cpu_ms();
  for (int k = 0; k < frames; ++k) draw(k);
  std::printf("heatmap alone, 760 x 420: %.1f ms CPU a frame\n", (cpu_ms() - before_ms) / frames);
}

} // namespace

int main(int argc, char** argv) {
  if (std::getenv("QT_QPA_PLATFORM") == nullptr) setenv("QT_QPA_PLATFORM", "offscreen", 1);
  const palp::Application application(argc, argv);
  heatmapAlone(200);
  page(argc > 1 ? std::atoi(argv[1]) : 10);
  return 0;
}
