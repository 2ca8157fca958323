#include "app/cli/Cli.h"
#include "app/cli/MeshCostLine.h"
#include "app/cli/Options.h"
#include "app/cli/Pictures.h"
#include "app/cli/ProgressBar.h"
#include "app/study/paper/PaperProtocol.h"
#include "app/study/paper/PaperReport.h"
#include "app/study/reports/ReportPage.h"
#include "io/FilesTogether.h"
#include "model/base/NumberText.h"

#include <chrono>
#include <cstdio>
#include <iostream>
#include <memory>

namespace palp {

namespace {

using Json = nlohmann::ordered_json;

struct ReproduceArguments {
  std::string what = "all";
  std::string seeds = "1";
  std::string firstSeed = "1";
  MeshChoice mesh;
  std::filesystem::path folder = "palp-paper";
  bool force = false;
};

Json toJson(const Eigen::Vector3d& values) {
  return {values.x(), values.y(), values.z()};
}

Json rowsJson(const ProtocolCurve& curve) {
  Json rows = Json::array();
  for (const ProtocolRow& row : curve.rows)
    rows.push_back({{"spread", row.spread ? Json(*row.spread) : Json()},
                    {"published_percent", row.published_percent ? toJson(*row.published_percent) : Json()},
                    {"eq13_percent", toJson(row.eq13Mean_percent())},
                    {"eq13_worst_area_percent", toJson(row.eq13Worst_percent())},
                    {"eq13_floored_percent", toJson(row.eq13FlooredMean_percent())},
                    {"mean_absolute_N", toJson(row.meanAbsolute_N())},
                    {"rmse_percent_of_range", toJson(row.rmse_percentOfRange())},
                    {"condition", row.condition}});
  return {{"what", curve.what}, {"rows", std::move(rows)}};
}

void print(const ProtocolResult& result) {
  std::string figure;
  for (const ProtocolCurve& curve : result.curves) {
    if (curve.figure != figure)
      std::printf("\n%s: Eq. (13) in %% for Fx, Fy, Fz; mean of the six test areas\n%-13s %6s  %24s  %27s  %27s\n",
                  curve.figure == "table1" ? "Table 1 (from deformation)" : "Fig. 12 (from resistance)", "way",
                  "spread", "paper", "mean", "worst area");
    figure = curve.figure;
    for (const ProtocolRow& row : curve.rows) {
      const Eigen::Vector3d mean = row.eq13Mean_percent();
      const Eigen::Vector3d worst = row.eq13Worst_percent();
      std::printf("%-13s %6s  ", curve.mode.c_str(), row.spread ? shortNumber(*row.spread).c_str() : "-");
      if (const auto& paper = row.published_percent)
        std::printf("%8s%8s%8s  ", withDecimals(paper->x(), 2).c_str(), withDecimals(paper->y(), 2).c_str(),
                    withDecimals(paper->z(), 2).c_str());
      else
        std::printf("%24s  ", "");
      const auto cell = [](double value) { return withDigits(value, 3); };
      std::printf("%9s%9s%9s  %9s%9s%9s\n", cell(mean.x()).c_str(), cell(mean.y()).c_str(), cell(mean.z()).c_str(),
                  cell(worst.x()).c_str(), cell(worst.y()).c_str(), cell(worst.z()).c_str());
    }
  }
}

std::vector<std::string> figures(const std::string& what) {
  if (what == "table1" || what == "fig12") return {what};
  return {"table1", "fig12"};
}

Exit run(const ReproduceArguments& arguments, Session& session) {
  const auto start = std::chrono::steady_clock::now();
  ProtocolOptions options;
  options.seeds = wholeNumber("--seeds", arguments.seeds, 1, 1000);
  options.firstSeed = static_cast<std::uint64_t>(wholeNumber("--first-seed", arguments.firstSeed, 0, 1'000'000));
  options.mesh = arguments.mesh.options();
  options.threads = session.threads;
  const OutputFolder folder(arguments.folder, arguments.force);

  const SensorDesign design = paperDesign();
  printMeshCost(design, options.mesh, session);
  ProgressBar bar("reproduce", 1000);
  const auto result = runPaperProtocol(
      design, figures(arguments.what), options,
      [&](double share, const std::string& what) { bar.show(static_cast<std::size_t>(1000 * share), what); },
      session.stop);
  if (!result) return Exit::NoResult;
  session.stages.add(result->stages);

  FilesTogether files(arguments.folder);
  std::vector<ReportPicture> pictures;
  if (arguments.what == "figures" || arguments.what == "all")
    pictures = drawPaperFigures(design, *result, options.mesh, files, session);
  ReportRun run;
  run.command = "palp reproduce " + arguments.what + " --seeds " + arguments.seeds + " --first-seed " +
                arguments.firstSeed + arguments.mesh.asCommand() + " -o " + arguments.folder.string();
  run.seeds = options.seeds;
  run.firstSeed = options.firstSeed;
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const std::filesystem::path page = arguments.folder / "report.html", csv = arguments.folder / "errors.csv";
  files.add("errors.csv", protocolCsv(*result));
  files.add("report.html", paperReportHtml(*result, pictures, run));
  files.commit();

  for (const ProtocolCurve& curve : result->curves) session.result[curve.figure][curve.mode] = rowsJson(curve);
  session.result["samples"] = result->samples;
  session.result["mesh"] = result->mesh;
  session.result["report"] = page.string();
  session.result["csv"] = csv.string();
  session.result["seconds"] = run.seconds;
  if (!session.json) {
    print(*result);
    std::cout << "\n" << page.string() << " and " << csv.string() << " written\n";
  }
  return Exit::Done;
}

} // namespace

void addReproduce(Cli& cli) {
  auto arguments = std::make_shared<ReproduceArguments>();
  Command command = cli.command(
      "reproduce", "Repeats the paper's experiments from scratch and compares its printed numbers with ours.",
      "palp reproduce all --seeds 5 -o out/paper", [arguments](Session& session) { return run(*arguments, session); });
  command.option("what", arguments->what, "TEXT", "table1, fig12, figures or all (default)")
      .oneOf({"table1", "fig12", "figures", "all"});
  command.group("Samples");
  command.option("--seeds", arguments->seeds, "N", "repetitions with other forces; medians are printed (default 1)");
  command.option("--first-seed", arguments->firstSeed, "N", "seed of the first repetition (default 1)");
  arguments->mesh.declare(command, false);
  command.group("Output");
  command.option("-o,--output", arguments->folder, "FOLDER",
                 "folder to write report.html, errors.csv and the pictures to");
  command.flag("--force", arguments->force, "write to a folder that is not empty");
}

} // namespace palp
