#include "app/study/reports/ScenesReport.h"

#include "app/study/ReportPage.h"
#include "app/study/Touch.h"
#include "app/study/reports/Csv.h"
#include "app/study/reports/ProcessMemory.h"
#include "app/study/reports/Timing.h"

#include <array>

namespace palp {

namespace {

constexpr std::array kStages{"mesh", "factorise", "solve"};

/// A scene by the furthest stage that it shows, as the window asks for it.
struct SceneNeed {
  std::string name;
  Stage stage;
};

std::vector<SceneNeed> scenes() {
  return {{"Design", Stage::Design},          {"Design, mesh shown", Stage::Mesh}, {"Deformation", Stage::Resistances},
          {"Resistance", Stage::Resistances}, {"Network", Stage::Design},          {"Live", Stage::Design},
          {"Reports", Stage::Design}};
}

/// Stages that a stage needs, as the chain is drawn: what may run, and no more.
int allowedRuns(Stage stage, const std::string& name) {
  if (name == "mesh") return stage >= Stage::Mesh ? 1 : 0;
  return stage >= Stage::Solution ? 1 : 0;
}

/// One event in a scene and what it cost.
struct SceneCost {
  std::string scene, event;
  std::array<int, kStages.size()> runs{};
  double seconds = 0;
  double memory_MB = 0; ///< that came to be held
  bool tooMuch = false; ///< a stage ran that the scene does not show
};

class SceneMeter {
public:
  SceneMeter(const ReportRequest& request, const std::stop_token& stop) : request_(request), stop_(stop) {
    load_.areas.push_back({0, (request.design.forceRange.low_N + request.design.forceRange.high_N) / 2});
    otherLoad_.areas.push_back({request.design.areas.count() - 1, load_.areas[0].force_N});
    newton_.threads = request.threads;
  }

  /// Opening, then each change in the scene that stays open; after each change another scene would be hidden.
  void run(const SceneNeed& scene, std::vector<SceneCost>& costs) {
    Touch touch(request_.design, load_, request_.mesh);
    costs.push_back(cost(scene, "opening", touch, scene.stage));
    costs.push_back(cost(scene, "nothing changed", touch, scene.stage));
    touch.setLoad(otherLoad_);
    costs.push_back(cost(scene, "another load", touch, scene.stage));
    SensorDesign design = request_.design;
    design.material.c10_MPa *= 0.9;
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

} // namespace

std::optional<ReportContent> scenesReport(const ReportRequest& request, const ReportProgress& progress,
                                          std::stop_token stop) {
  requireValid(request.design);
  std::vector<SceneCost> costs;
  SceneMeter meter(request, stop);
  const std::vector<SceneNeed> all = scenes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (stop.stop_requested()) return {};
    if (progress) progress(static_cast<double>(i) / static_cast<double>(all.size()), all[i].name);
    meter.run(all[i], costs);
  }
  if (stop.stop_requested()) return {};

  ReportContent content;
  content.title = "Scenes: what each computes";
  ReportTable table{"A row is green where no stage ran that the scene does not show",
                    {"scene", "event", "meshes", "factorisations", "solves", "seconds", "memory [MB]"},
                    {},
                    {}};
  Csv csv({"scene", "event", "mesh_runs", "factorise_runs", "solve_runs", "seconds", "memory_MB", "too_much"});
  int tooMuch = 0;
  for (const SceneCost& c : costs) {
    table.rows.push_back({c.scene, c.event, std::to_string(c.runs[0]), std::to_string(c.runs[1]),
                          std::to_string(c.runs[2]), shortNumber(c.seconds), shortNumber(c.memory_MB)});
    table.marks.push_back(c.tooMuch ? ReportTable::Mark::Bad : ReportTable::Mark::Good);
    csv.add({c.scene, c.event, c.runs[0], c.runs[1], c.runs[2], c.seconds, c.memory_MB, c.tooMuch ? 1 : 0});
    tooMuch += c.tooMuch ? 1 : 0;
  }
  content.parts.push_back(ReportWords{
      "The chain is design, mesh, solution, displacements, resistances. A scene names the furthest stage that it "
      "shows; "
      "a change drops what comes after it; a hidden scene asks for nothing. Counted here with the very chain (Touch) "
      "that the window uses, without its pictures; memory is what the process holds more after the event, which the "
      "allocator may keep from before."});
  content.parts.emplace_back(std::move(table));
  content.summary = std::to_string(costs.size()) + " events in " + std::to_string(all.size()) + " scenes: in " +
                    std::to_string(tooMuch) + " of them a stage ran that the scene does not show.";
  content.csv = csv.text();
  return content;
}

} // namespace palp
