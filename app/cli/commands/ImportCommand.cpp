#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "app/cli/ProgressBar.h"
#include "io/AtomicFile.h"
#include "io/ImportSamples.h"

#include <iostream>
#include <memory>
#include <optional>

namespace palp {

namespace {

struct ImportArguments {
  std::vector<std::string> tables;
  std::string map;
  std::string saveMap;
  std::string design;
  bool leaveOutBadRows = false;
  OutputFile output;
};

Exit run(const ImportArguments& arguments, Session& session) {
  arguments.output.requireWritable();
  std::optional<SensorDesign> design;
  if (!arguments.design.empty()) design = designOption(arguments.design);
  ImportRequest request{{arguments.tables.begin(), arguments.tables.end()}, arguments.map};
  request.design = design ? &*design : nullptr;
  request.output = arguments.output.path;
  request.force = arguments.output.force;
  request.leaveOutBadRows = arguments.leaveOutBadRows;
  if (!arguments.saveMap.empty()) {
    const std::string json = arguments.map.empty() ? guessImportMap(request.tables).json : readFile(arguments.map);
    writeFile(arguments.saveMap, json, arguments.output.force);
  }
  ProgressBar bar("importing", 1000);
  const Imported imported = importSamples(
      request, [&](double share) { bar.show(static_cast<std::size_t>(1000 * share)); }, session.stop);
  session.result["samples"] = imported.samples;
  session.result["runs"] = imported.runs;
  session.result["left_out"] = imported.leftOut;
  session.result["unused_columns"] = imported.unusedColumns;
  session.result["design"] = imported.design;
  session.result["notes"] = imported.notes;
  session.result["file"] = arguments.output.path.string();
  std::vector<std::string> warnings = imported.warnings;
  if (!imported.constant.empty()) warnings.push_back(imported.constant);
  for (const std::string& warning : warnings) {
    std::cerr << "palp import: " << warning << '\n';
    session.warnings.push_back(warning);
  }
  if (session.json) return Exit::Done;
  for (const std::string& note : imported.notes) std::cout << note << '\n';
  std::cout << imported.samples << " samples of design " << imported.design << " in " << arguments.output.path.string()
            << "; " << imported.unusedColumns << " columns of the table not used\n";
  return Exit::Done;
}

} // namespace

void addImport(Cli& cli) {
  auto arguments = std::make_shared<ImportArguments>();
  Command command =
      cli.command("import", "Converts measured data of another rig to samples: tables as they were published.",
                  "palp import table.csv --map map.json -o samples.h5",
                  [arguments](Session& session) { return run(*arguments, session); });
  command
      .option("table", arguments->tables, "FILE...",
              "table of text (CSV, any separator), or NPZ with a row per sample; several: as the map states, or runs")
      .required();
  command.group("Input");
  command.option("--map", arguments->map, "FILE",
                 "JSON file: which columns are readings, forces, areas or positions, time and run; their units "
                 "(default: by the names of the columns)");
  command.option("--save-map", arguments->saveMap, "FILE", "writes the map that was used");
  command.flag("--leave-out-bad-rows", arguments->leaveOutBadRows,
               "imports the other rows where some have words, missing values or other numbers of fields");
  command.option("--design", arguments->design, "DESIGN",
                 "design of the measured sensor: a file, or paper (default: unknown)");
  arguments->output.declare(command, "sample file to write: .csv, .h5 or .npz").required();
}

} // namespace palp
