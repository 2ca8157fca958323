#include "app/study/reports/scenes/WindowCosts.h"

#include "app/study/ChildProcess.h"
#include "app/study/reports/scenes/CommandCosts.h"
#include "io/DesignFile.h"
#include "model/base/GotExpected.h"

#include <nlohmann/json.hpp>

namespace palp {

namespace {

constexpr double kWindowLimit_s = 240;

WindowStep stepOf(const nlohmann::json& json) {
  WindowStep step;
  step.scene = json.at("scene");
  step.event = json.at("event");
  for (std::size_t s = 0; s < kChainStages.size(); ++s) step.runs[s] = json.at(kChainStages[s]);
  step.pictures = json.at("pictures");
  step.hiddenPictures = json.at("hidden_pictures");
  step.seconds = json.at("seconds");
  step.cpu_s = json.at("cpu_s");
  step.held_MB = json.at("held_MB");
  step.peak_MB = json.at("peak_MB");
  step.showsMesh = json.at("shows_mesh");
  step.showsSolution = json.at("shows_solution");
  step.complete = json.at("complete");
  return step;
}

/// One run of the window; the scenes that it has.
std::vector<std::string> add(WindowCosts& costs, const ReportRequest& request, const std::string& scene,
                             const std::stop_token& stop) {
  const ScratchFolder folder;
  saveDesign(folder.path() / "sensor.json", request.design, true);
  ChildOrder order{request.programs / "palp-studio", {"--costs"}, folder.path(), {}, kWindowLimit_s};
  if (!scene.empty()) order.arguments.insert(order.arguments.end(), {"--scene", scene});
  const std::vector<std::string> mesh = meshArguments(request.mesh);
  order.arguments.insert(order.arguments.end(), mesh.begin(), mesh.end());
  order.arguments.emplace_back("sensor.json");
  // No display, and settings of its own: the user's are neither read nor changed.
  order.environment = {"QT_QPA_PLATFORM=offscreen", "XDG_RUNTIME_DIR=" + folder.path().string(),
                       "XDG_CONFIG_HOME=" + folder.path().string()};
  const ChildRun run = runChild(order, stop);
  if (!run.failed.empty()) {
    costs.failed = (scene.empty() ? "all scenes" : "scene " + scene) + ": " + run.failed;
    return {};
  }
  const nlohmann::json result = nlohmann::json::parse(run.output);
  costs.window_px = result.at("window_px");
  for (const nlohmann::json& step : result.at("steps")) costs.steps.push_back(stepOf(step));
  return result.at("scenes");
}

} // namespace

std::string WindowStep::fault() const {
  const bool again = event == "in turn again" || event == "left alone" || event.starts_with("hidden");
  const std::array allowed{showsMesh && !again ? 1 : 0, showsSolution && !again ? 1 : 0,
                           showsSolution && !again ? 1 : 0};
  for (std::size_t s = 0; s < runs.size(); ++s)
    if (runs[s] > allowed[s])
      return std::string("runs of ") + kChainStages[s] + ": " +
             gotExpected(std::to_string(runs[s]), "at most " + std::to_string(allowed[s]));
  if (hiddenPictures > 0) return std::to_string(hiddenPictures) + " pictures drawn while hidden";
  return complete ? "" : "never complete";
}

WindowCosts windowCosts(const ReportRequest& request, const ReportProgress& progress, const std::stop_token& stop) {
  WindowCosts costs;
  if (progress) progress(0, "all scenes in turn");
  const std::vector<std::string> scenes = add(costs, request, "", stop);
  for (std::size_t i = 0; i < scenes.size() && costs.failed.empty(); ++i) {
    if (progress)
      progress(static_cast<double>(i + 1) / static_cast<double>(scenes.size() + 1), "the window, scene " + scenes[i]);
    add(costs, request, scenes[i], stop);
  }
  return costs;
}

} // namespace palp
