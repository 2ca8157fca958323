#include "app/cli/Cli.h"
#include "app/cli/MeshCostLine.h"
#include "app/cli/Options.h"
#include "app/cli/Pictures.h"
#include "app/cli/ProgressBar.h"
#include "app/cli/TouchOption.h"
#include "app/study/reports/ReportComputations.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/map/TouchMap.h"
#include "model/base/Text.h"

#include <algorithm>
#include <iostream>
#include <memory>

namespace palp {

namespace {

struct ReportArguments {
  std::string kind;
  std::string design = "paper";
  std::string perArea = "100";
  std::string seed = "1";
  MeshChoice mesh;
  TouchArguments touches;
  std::filesystem::path folder;
  bool force = false;
};

std::vector<std::string> kindNames() {
  std::vector<std::string> names;
  for (const ReportComputation& kind : reportComputations()) names.push_back(kind.name);
  return names;
}

/// The kinds and what they show, for the help.
std::string kindsInWords() {
  std::string words;
  for (const ReportComputation& kind : reportComputations())
    words += (words.empty() ? "" : "; ") + kind.name + ": " + kind.what;
  return words;
}

std::string commandLine(const ReportArguments& arguments) {
  return "palp report " + arguments.kind + (arguments.design == "paper" ? "" : " --design " + arguments.design) +
         " --per-area " + arguments.perArea + " --seed " + arguments.seed + arguments.mesh.asCommand() +
         arguments.touches.asCommand() + " -o " + arguments.folder.string();
}

/// The mesh that most of its work is done on.
MeshOptions meshOf(const ReportRequest& request, const std::string& kind) {
  if (kind != "map" && !request.touches) return request.mesh;
  return meshForTouches(request.design, request.touches ? *request.touches : touchesOf(request.design), request.mesh);
}

Exit run(ReportArguments& arguments, Session& session) {
  if (arguments.folder.empty()) arguments.folder = "palp-report-" + arguments.kind;
  const std::vector<ReportComputation>& kinds = reportComputations();
  const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const auto& k) { return k.name == arguments.kind; });
  ReportRequest request;
  request.design = kind->underField ? designOption(arguments.design)
                                    : pairsDesignOption(arguments.design, "report " + arguments.kind);
  if (request.design.field() != nullptr) requireSmoothAtRest(request.design); // before a word about charts
  request.folder = arguments.folder;
  request.mesh = arguments.mesh.options();
  request.perArea = wholeNumber("--per-area", arguments.perArea, 5, 100000);
  request.seed = static_cast<std::uint64_t>(wholeNumber("--seed", arguments.seed, 0, 1'000'000));
  if (arguments.touches.given()) {
    if (arguments.kind != "map" && arguments.kind != "layout")
      throw UsageError("--touch: not for report " + arguments.kind + "; expected report map or layout");
    request.touches = arguments.touches.range(request.design);
    (void)mapRequest(*request.touches, request.design, 1e-4, {2, 2}, "report " + arguments.kind); // refuses
  }
  const OutputFolder folder(arguments.folder, arguments.force);            // once the options are right
  printMeshCost(request.design, meshOf(request, arguments.kind), session); // refuses as well: some kinds mesh late
  request.threads = session.threads;
  request.command = commandLine(arguments);

  ProgressBar bar("report " + arguments.kind, 1000);
  const ReportOutcome outcome = runReport(
      *kind, request,
      [&](double share, const std::string& what) { bar.show(static_cast<std::size_t>(1000 * share), what); },
      session.stop, reportDrawer(session));
  session.stages.add(outcome.stages);
  session.warnings.insert(session.warnings.end(), outcome.warnings.begin(), outcome.warnings.end());
  session.result["kind"] = arguments.kind;
  if (!outcome.done) return Exit::NoResult;
  session.result["report"] = outcome.page.string();
  session.result["csv"] = outcome.csv.string();
  session.result["summary"] = outcome.summary;
  for (const auto& [name, value] : outcome.figures) session.result["figures"][name] = value;
  session.result["seconds"] = outcome.seconds;
  if (!session.json)
    std::cout << outcome.summary << "\n" << outcome.page.string() << " and " << outcome.csv.string() << " written\n";
  return Exit::Done;
}

} // namespace

void addReport(Cli& cli) {
  auto arguments = std::make_shared<ReportArguments>();
  Command command = cli.command(
      "report", "Writes a report with charts, a CSV of every point and the command that made it.",
      "palp report layout -o out/layout", [arguments](Session& session) { return run(*arguments, session); });
  command.option("kind", arguments->kind, "TEXT", kindsInWords()).required().oneOf(kindNames());
  command.group("Design and samples");
  command.option("--design", arguments->design, "DESIGN", "design file, or paper (default)");
  command.option("--per-area", arguments->perArea, "N", "samples per area, if the report needs samples (default 100)");
  command.option("--seed", arguments->seed, "N", "seed of all random numbers (default 1)");
  arguments->mesh.declare(command, false);
  arguments->touches.declareForMap(command);
  command.group("Output");
  command.option("-o,--output", arguments->folder, "FOLDER",
                 "folder to write report.html, points.csv and the pictures to (default palp-report-KIND)");
  command.flag("--force", arguments->force, "write to a folder that is not empty");
}

} // namespace palp
