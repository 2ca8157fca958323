#include "app/cli/Cli.h"
#include "app/cli/MeshCostLine.h"
#include "app/cli/Options.h"
#include "app/cli/Pictures.h"
#include "app/cli/ProgressBar.h"
#include "app/cli/ShardOption.h"
#include "app/study/studies/StudyReport.h"
#include "io/DesignFile.h"
#include "model/base/Error.h"
#include "solver/MeshCost.h"

#include <chrono>
#include <iostream>
#include <memory>
#include <optional>

namespace palp {

namespace {

struct StudyArguments {
  std::filesystem::path study, folder;
  std::string shard;
  bool retryProblems = false;
};

constexpr std::size_t kProgressSteps = 10'000;

constexpr std::size_t kMostToEstimate = 1000; // designs: each takes some tenths of a millisecond

/// Of the designs that are not done yet, the one with the largest mesh; of very many, of evenly chosen ones.
void printLargestMesh(const StudyFolder& study, const SampleRange& range, Session& session) {
  const MeshOptions options{.meshSize_mm = study.plan().meshSize_mm, .mapped = study.plan().mapped};
  std::optional<std::size_t> largest;
  double most = 0;
  const std::size_t stride = 1 + (range.last - range.first) / kMostToEstimate;
  for (std::size_t i = range.first; i < range.last; i += stride) {
    if (study.done(i)) continue;
    try {
      const double elements = meshCost(study.plan().at(i), options).elements;
      if (elements <= most) continue;
      most = elements;
      largest = i;
    } catch (const Error&) { // a row of its own states why
      continue;
    }
  }
  if (largest) printMeshCost(study.plan().at(*largest), options, session, "design " + std::to_string(*largest) + ": ");
}

Exit run(const StudyArguments& arguments, Session& session) {
  const auto start = std::chrono::steady_clock::now();
  requireNoStream("--output", arguments.folder);
  StudyFolder study(arguments.folder, loadStudy(arguments.study));
  const std::size_t all = study.plan().designs();
  const SampleRange range = shardOption(arguments.shard, all);
  if (std::string mixed = study.mixedPrograms(); !mixed.empty()) {
    session.warnings.push_back(arguments.folder.string() + ": " + mixed);
    std::cerr << "palp study: " << session.warnings.back() << '\n';
  }
  printLargestMesh(study, range, session);
  ProgressBar bar("study", kProgressSteps);
  const bool whole = study.compute(
      range.first, range.last, session.threads,
      [&](double share, const std::string& now) { bar.show(static_cast<std::size_t>(kProgressSteps * share), now); },
      session.stop, arguments.retryProblems);
  const std::size_t done = study.rowsDone();
  session.result["designs"] = all;
  session.result["done"] = done;
  if (!whole) {
    if (!session.json) std::cout << done << " of " << all << " designs done; the same command continues from here\n";
    return Exit::NoResult;
  }
  if (done < all || !arguments.shard.empty()) {
    if (!session.json) std::cout << done << " of " << all << " designs done in " << arguments.folder.string() << '\n';
    return Exit::Done;
  }
  study.writeTable();
  const ReportContent content = studyReport(study);
  ReportRequest request;
  request.folder = arguments.folder / "report";
  request.design = parseDesign(study.plan().design, "study.json");
  request.seed = study.plan().seed;
  request.command = "palp study " + arguments.study.string() + " -o " + arguments.folder.string();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const ReportOutcome outcome = writeReport(content, request, seconds, reportDrawer(session), session.stop);
  session.warnings.insert(session.warnings.end(), outcome.warnings.begin(), outcome.warnings.end());
  session.result["table"] = study.table().string();
  session.result["report"] = outcome.page.string();
  session.result["summary"] = outcome.summary;
  for (const auto& [name, value] : outcome.figures) session.result["figures"][name] = value;
  if (!session.json)
    std::cout << outcome.summary << "\n" << study.table().string() << " and " << outcome.page.string() << " written\n";
  return Exit::Done;
}

} // namespace

void addStudy(Cli& cli) {
  auto arguments = std::make_shared<StudyArguments>();
  Command command = cli.command("study", "Computes many designs, given by lists and ranges of numbers, into one table.",
                                "palp study study.json -o depths",
                                [arguments](Session& session) { return run(*arguments, session); });
  command.option("study", arguments->study, "FILE", "study file: the design, what varies and what is computed")
      .required();
  command.group("Output");
  command
      .option("-o,--output", arguments->folder, "FOLDER",
              "folder for rows, table and report; a stopped study is continued")
      .required();
  command.group("Designs");
  command.option("--shard", arguments->shard, "I/N",
                 "compute part I of N; without it the remaining rows and the table");
  command.flag("--retry-problems", arguments->retryProblems, "compute designs again whose rows have a problem");
}

} // namespace palp
