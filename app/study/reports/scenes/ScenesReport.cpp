#include "app/study/reports/scenes/ScenesReport.h"

#include "app/study/reports/ProcessMemory.h"
#include "app/study/reports/ReportWriter.h"
#include "app/study/reports/Timing.h"
#include "app/study/touch/Touch.h"

#include <algorithm>
#include <array>

namespace palp {

namespace {

/// The stages of the chain that are counted, in their order.
constexpr std::array<const char*, 3> kStages{"mesh", "factorise", "solve"};

/// A scene by the furthest stage that it shows, as the window requests it.
struct SceneNeed {
  std::string name;
  Stage stage;
};

std::vector<SceneNeed> scenes() {
  return {{"Design", Stage::Design},          {"Design, mesh shown", Stage::Mesh}, {"Deformation", Stage::Resistances},
          {"Resistance", Stage::Resistances}, {"Network", Stage::Design},          {"Live", Stage::Design},
          {"Reports", Stage::Design}};
}

/// Largest number of runs of a stage where the chain is needed up to another.
int allowedRuns(Stage stage, const std::string& name) {
  if (name == "mesh") return stage >= Stage::Mesh ? 1 : 0;
  return stage >= Stage::Solution ? 1 : 0;
}

/// One event in a scene and what it cost.
struct SceneCost {
  std::string scene, event;
  std::array<int, kStages.size()> runs{};
  double seconds = 0;
  double memory_MB = 0; ///< increase of the process's memory
  bool tooMuch = false; ///< a stage ran that the scene does not show
};

class SceneMeter {
public:
  SceneMeter(const ReportRequest& request, const std::stop_token& stop) : request_(request), stop_(stop) {
    load_.areas.push_back({0, (request.design.forceRange.low_N + request.design.forceRange.high_N) / 2});
    otherLoad_.areas.push_back({request.design.areas.count() - 1, load_.areas[0].force_N});
    newton_.threads = request.threads;
  }

  /// Opening, then each change in the open scene, then one while it is hidden.
  void run(const SceneNeed& scene, std::vector<SceneCost>& costs) {
    Touch touch(request_.design, load_, request_.mesh);
    costs.push_back(cost(scene, "opening", touch, scene.stage));
    costs.push_back(cost(scene, "nothing changed", touch, scene.stage));
    touch.setLoad(otherLoad_);
    costs.push_back(cost(scene, "another load", touch, scene.stage));
    SensorDesign design = request_.design;
    design.material.law = timesStress(design.material.law, 0.9);
    touch.setDesign(design);
    costs.push_back(cost(scene, "another material", touch, scene.stage));
    for (std::vector<double>& depths : design.lower.z_mm)
      for (double& z : depths) z *= 0.9;
    touch.setDesign(design);
    costs.push_back(cost(scene, "lower layer moved", touch, scene.stage));
    for (std::vector<double>& depths : design.upper.z_mm)
      for (double& z : depths) z *= 0.99;
    touch.setDesign(design);
    costs.push_back(cost(scene, "upper layer moved", touch, scene.stage));
    touch.setLoad(load_);
    costs.push_back(cost(scene, "another load while hidden", touch, Stage::Design));
  }

private:
  SceneCost cost(const SceneNeed& scene, const std::string& event, Touch& touch, Stage stage) const {
    SceneCost result{scene.name, event, {}, 0, 0, false};
    std::array<int, kStages.size()> before{};
    for (std::size_t s = 0; s < kStages.size(); ++s) before[s] = touch.stages().runs(kStages[s]);
    const double memoryBefore = heldMemory_MB();
    result.seconds = secondsOf([&] { touch.advance(stage, newton_, {{}, stop_}); });
    result.memory_MB = heldMemory_MB() - memoryBefore;
    for (std::size_t s = 0; s < kStages.size(); ++s) {
      result.runs[s] = touch.stages().runs(kStages[s]) - before[s];
      const bool nothingNew = event == "nothing changed";
      if (result.runs[s] > (nothingNew ? 0 : allowedRuns(stage, kStages[s]))) result.tooMuch = true;
    }
    return result;
  }

  const ReportRequest& request_;
  const std::stop_token& stop_;
  LoadCase load_, otherLoad_;
  NewtonOptions newton_;
};

class ScenesWriter : ReportWriter {
public:
  ScenesWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : ReportWriter(request, std::move(progress), std::move(stop), "scenes",
                     {"part", "what", "event", "mesh_runs", "factorise_runs", "solve_runs", "pictures", "drawn_unseen",
                      "seconds", "cpu_s", "held_MB", "most_MB", "fault"}) {}

  std::optional<ReportContent> run() {
    std::vector<SceneCost> costs;
    SceneMeter meter(request_, stop_);
    const std::vector<SceneNeed> all = scenes();
    for (std::size_t i = 0; i < all.size() && !stop_.stop_requested(); ++i) {
      progress(static_cast<double>(i) / static_cast<double>(all.size()), all[i].name);
      meter.run(all[i], costs);
    }
    if (stop_.stop_requested()) return {};
    ReportTable table = words_.table("chain table");
    for (const SceneCost& c : costs) {
      table.add({c.scene, c.event, c.runs[0], c.runs[1], c.runs[2], c.seconds, c.memory_MB},
                c.tooMuch ? ReportTable::Mark::Bad : ReportTable::Mark::Good);
      csv_.add({"chain", c.scene, c.event, c.runs[0], c.runs[1], c.runs[2], "", "", c.seconds, "", "", c.memory_MB,
                c.tooMuch ? "a stage ran that is not shown" : ""});
    }
    heading("chain heading");
    paragraph("chain");
    add(std::move(table));
    content_.summary =
        words_("summary", {{"events", costs.size()}, {"faults", std::ranges::count_if(costs, &SceneCost::tooMuch)}});
    return finished();
  }
};

} // namespace

std::optional<ReportContent> scenesReport(const ReportRequest& request, const ReportProgress& progress,
                                          std::stop_token stop) {
  requireValid(request.design);
  return ScenesWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
