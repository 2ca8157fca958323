#include "app/study/reports/scenes/CommandCosts.h"

#include "app/study/ChildProcess.h"
#include "app/study/paper/PaperProtocol.h"
#include "io/DesignFile.h"
#include "model/base/Text.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace palp {

namespace {

using Words = std::vector<std::string>;

constexpr double kCommandLimit_s = 240;
constexpr int kManySamples = 100000; ///< of surrogates, where the request asks for 100 an area

Words split(const std::string& text) {
  std::istringstream stream(text);
  Words words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string joined(const Words& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// What the command says of its stages; the last line where it prints one object a line.
nlohmann::json resultOf(const std::string& output) {
  nlohmann::json whole = nlohmann::json::parse(output, nullptr, false);
  if (!whole.is_discarded()) return whole;
  const std::size_t end = output.find_last_not_of('\n');
  const std::size_t start = end == std::string::npos ? std::string::npos : output.rfind('\n', end);
  return start == std::string::npos ? whole : nlohmann::json::parse(output.substr(start), nullptr, false);
}

void addStages(CommandCost& cost, const std::string& output) {
  const nlohmann::json result = resultOf(output);
  if (!result.is_object() || !result.contains("stages")) return;
  for (const auto& [stage, count] : result["stages"].items()) {
    const int runs = count.value("runs", 0);
    cost.stages += (cost.stages.empty() ? "" : ", ") + stage + " " + std::to_string(runs);
  }
}

int pictureFiles(const std::filesystem::path& folder) {
  const std::filesystem::recursive_directory_iterator files(folder);
  return static_cast<int>(
      std::count_if(begin(files), end(files), [](const auto& file) { return file.path().extension() == ".png"; }));
}

/// The commands in an order in which each finds the files that it reads.
std::vector<Words> commands(const ReportRequest& request) {
  const Words mesh = meshArguments(request.mesh);
  const auto meshed = [&](const std::string& text) {
    Words words = split(text);
    words.insert(words.end() - 2, mesh.begin(), mesh.end()); // before -o FILE
    return words;
  };
  const Eigen::Vector3d force_N = (request.design.forceRange.low_N + request.design.forceRange.high_N) / 2;
  const std::string load = " --load 0:" + text(force_N.x()) + "," + text(force_N.y()) + "," + text(force_N.z());
  const std::string samples = "sample sensor.json --per-area " + std::to_string(request.perArea) + " --seed ";
  const std::string seed = std::to_string(request.seed), other = std::to_string(testSeed(request.seed));
  const int many =
      (kManySamples / 100 * request.perArea + request.design.areas.count() - 1) / request.design.areas.count();
  return {split("design --check sensor.json"),
          meshed("mesh sensor.json -o mesh.vtu"),
          meshed("solve sensor.json" + load + " -o deformed.vtu"),
          meshed("render sensor.json" + load + " -o picture.png"),
          meshed(samples + seed + " -o train.csv"),
          meshed(samples + other + " --shard 1/2 -o part1.csv"),
          meshed(samples + other + " --shard 2/2 -o part2.csv"),
          split("merge part1.csv part2.csv -o test.csv"),
          meshed("sample sensor.json --surrogate --per-area " + std::to_string(many) + " -o many.csv"),
          split("train train.csv --input resistance --rows all --noise 1e-4 -o network.json"),
          split("predict network.json test.csv --noise 1e-4 -o forces.csv"),
          split("sweep train.csv --test test.csv"),
          split("calibrate network.json test.csv -o better.json"),
          split("listen --simulate --seconds 2"),
          meshed("reproduce all -o paper")};
}

} // namespace

std::vector<std::string> meshArguments(const MeshOptions& mesh) {
  if (mesh.meshSize_mm) return {"--mesh-size", text(*mesh.meshSize_mm)};
  if (!mesh.mapped) return {};
  const auto& [x, y, z] = *mesh.mapped;
  return {"--mapped", std::to_string(x) + "x" + std::to_string(y) + "x" + std::to_string(z)};
}

std::vector<CommandCost> commandCosts(const ReportRequest& request, const ReportProgress& progress,
                                      const std::stop_token& stop) {
  const ScratchFolder folder;
  saveDesign(folder.path() / "sensor.json", request.design, true);
  std::vector<CommandCost> costs;
  const std::vector<Words> all = commands(request);
  for (std::size_t i = 0; i < all.size() && !stop.stop_requested(); ++i) {
    CommandCost cost;
    cost.command = "palp " + joined(all[i]);
    if (progress) progress(static_cast<double>(i) / static_cast<double>(all.size()), cost.command);
    ChildOrder order{request.programs / "palp", all[i], folder.path(), {}, kCommandLimit_s};
    order.arguments.emplace_back("--json");
    if (request.threads > 0)
      order.arguments.insert(order.arguments.end(), {"--threads", std::to_string(request.threads)});
    const int before = pictureFiles(folder.path());
    const ChildRun run = runChild(order, stop);
    cost.pictures = pictureFiles(folder.path()) - before;
    cost.seconds = run.seconds;
    cost.cpu_s = run.cpu_s;
    cost.peak_MB = run.peak_MB;
    cost.failed = run.failed;
    addStages(cost, run.output);
    costs.push_back(std::move(cost));
  }
  return costs;
}

} // namespace palp
