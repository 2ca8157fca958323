#include "app/study/reports/scenes/ScenesReport.h"

#include "app/study/reports/Csv.h"
#include "app/study/reports/ProcessMemory.h"
#include "app/study/reports/ReportPage.h"
#include "app/study/reports/ReportText.h"
#include "app/study/reports/Timing.h"
#include "app/study/reports/scenes/CommandCosts.h"
#include "app/study/reports/scenes/WindowCosts.h"
#include "app/study/touch/Touch.h"

#include <array>
#include <filesystem>

namespace palp {

namespace {

constexpr auto kStages = kChainStages;

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

/// Writes the report section by section; all rows are in one CSV.
class ScenesWriter {
public:
  ScenesWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : request_(request), progress_(std::move(progress)), stop_(std::move(stop)) {}

  std::optional<ReportContent> run() {
    content_.title = words_("title");
    chain();
    if (!stop_.stop_requested()) window();
    if (!stop_.stop_requested()) commands();
    if (stop_.stop_requested()) return {};
    content_.csv = csv_.text();
    return std::move(content_);
  }

private:
  void add(const std::string& sentence) { content_.parts.emplace_back(ReportWords{sentence}); }
  [[nodiscard]] bool has(const std::string& program) const {
    return !request_.programs.empty() && std::filesystem::exists(request_.programs / program);
  }

  void chain() {
    std::vector<SceneCost> costs;
    SceneMeter meter(request_, stop_);
    const std::vector<SceneNeed> all = scenes();
    for (std::size_t i = 0; i < all.size() && !stop_.stop_requested(); ++i) {
      partOf(progress_, 0, 0.15)(static_cast<double>(i) / static_cast<double>(all.size()), "the chain, " + all[i].name);
      meter.run(all[i], costs);
    }
    ReportTable table{words_("chain caption"),
                      {"scene", "event", "meshes", "factorisations", "solves", "seconds", "memory [MB]"},
                      {},
                      {}};
    int tooMuch = 0;
    for (const SceneCost& c : costs) {
      table.rows.push_back({c.scene, c.event, std::to_string(c.runs[0]), std::to_string(c.runs[1]),
                            std::to_string(c.runs[2]), shortNumber(c.seconds), shortNumber(c.memory_MB)});
      table.marks.push_back(c.tooMuch ? ReportTable::Mark::Bad : ReportTable::Mark::Good);
      csv_.add({"chain", c.scene, c.event, c.runs[0], c.runs[1], c.runs[2], "", "", c.seconds, "", "", c.memory_MB,
                c.tooMuch ? "a stage ran that is not shown" : ""});
      tooMuch += c.tooMuch ? 1 : 0;
    }
    content_.parts.push_back(ReportHeading{words_("chain heading")});
    add(words_("chain"));
    content_.parts.emplace_back(std::move(table));
    content_.summary =
        words_("chain summary", {{"events", std::to_string(costs.size())}, {"faults", std::to_string(tooMuch)}}) + " ";
  }

  void window() {
    content_.parts.push_back(ReportHeading{words_("window heading")});
    if (!has("palp-studio")) {
      add(words_("no window"));
      csv_.add({"window", "not run: no palp-studio in the folder of palp", "", "", "", "", "", "", "", "", "", "", ""});
      content_.summary += words_("no window summary") + " ";
      return;
    }
    const WindowCosts costs = windowCosts(request_, partOf(progress_, 0.15, 0.4), stop_);
    if (stop_.stop_requested()) return;
    ReportTable table{words_("window caption"),
                      {"scene", "step", "meshes", "factorisations", "solves", "pictures", "drawn unseen", "seconds",
                       "CPU [s]", "held [MB]", "at most [MB]"},
                      {},
                      {}};
    int faults = 0, solves = 0, unseen = 0;
    std::string words;
    for (const WindowStep& s : costs.steps) {
      const std::string fault = s.fault();
      table.rows.push_back({s.scene, s.event, std::to_string(s.runs[0]), std::to_string(s.runs[1]),
                            std::to_string(s.runs[2]), std::to_string(s.pictures), std::to_string(s.hiddenPictures),
                            shortNumber(s.seconds), shortNumber(s.cpu_s), shortNumber(s.held_MB),
                            shortNumber(s.peak_MB)});
      table.marks.push_back(fault.empty() ? ReportTable::Mark::Good : ReportTable::Mark::Bad);
      csv_.add({"window", s.scene, s.event, s.runs[0], s.runs[1], s.runs[2], s.pictures, s.hiddenPictures, s.seconds,
                s.cpu_s, s.held_MB, s.peak_MB, fault});
      if (!fault.empty()) words += s.scene + ", " + s.event + ": " + fault + ". ";
      faults += fault.empty() ? 0 : 1;
      unseen += s.hiddenPictures;
      if (s.event.starts_with("in turn")) solves += s.runs[2];
    }
    add(words_("window",
               {{"width", std::to_string(costs.window_px[0])}, {"height", std::to_string(costs.window_px[1])}}));
    content_.parts.emplace_back(std::move(table));
    if (!words.empty()) add(words_("faults", {{"faults", words}}));
    if (!costs.failed.empty()) {
      add(words_("incomplete", {{"why", costs.failed}}));
      csv_.add({"window", "not run to its end", costs.failed, "", "", "", "", "", "", "", "", "", costs.failed});
    }
    content_.summary +=
        words_("window summary", {{"steps", std::to_string(costs.steps.size())},
                                  {"faults", std::to_string(faults)},
                                  {"solves", std::to_string(solves) + (solves == 1 ? " solve" : " solves")},
                                  {"unseen", std::to_string(unseen)}}) +
        " " + (costs.failed.empty() ? "" : words_("incomplete summary") + " ");
  }

  void commands() {
    content_.parts.push_back(ReportHeading{words_("commands heading")});
    if (!has("palp")) {
      add(words_("no commands"));
      csv_.add(
          {"command", "not run: no palp in the folder of this program", "", "", "", "", "", "", "", "", "", "", ""});
      content_.summary += words_("no commands summary");
      return;
    }
    const std::vector<CommandCost> costs = commandCosts(request_, partOf(progress_, 0.55, 0.45), stop_);
    ReportTable table{words_("commands caption"),
                      {"command", "stages run", "pictures", "seconds", "CPU [s]", "at most [MB]"},
                      {},
                      {}};
    int failed = 0;
    for (const CommandCost& c : costs) {
      table.rows.push_back({c.command, c.failed.empty() ? c.stages : "failed: " + c.failed, std::to_string(c.pictures),
                            shortNumber(c.seconds), shortNumber(c.cpu_s), shortNumber(c.peak_MB)});
      table.marks.push_back(c.failed.empty() ? ReportTable::Mark::Plain : ReportTable::Mark::Bad);
      csv_.add(
          {"command", c.command, c.stages, "", "", "", c.pictures, "", c.seconds, c.cpu_s, "", c.peak_MB, c.failed});
      failed += c.failed.empty() ? 0 : 1;
    }
    add(words_("commands"));
    content_.parts.emplace_back(std::move(table));
    content_.summary +=
        words_("commands summary", {{"commands", std::to_string(costs.size())}, {"failed", std::to_string(failed)}});
  }

  const ReportText words_{"scenes"};
  const ReportRequest& request_;
  ReportProgress progress_;
  std::stop_token stop_;
  ReportContent content_;
  Csv csv_{{"part", "what", "event", "mesh_runs", "factorise_runs", "solve_runs", "pictures", "drawn_unseen", "seconds",
            "cpu_s", "held_MB", "most_MB", "fault"}};
};

} // namespace

std::optional<ReportContent> scenesReport(const ReportRequest& request, const ReportProgress& progress,
                                          std::stop_token stop) {
  requireValid(request.design);
  return ScenesWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
