#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "app/cli/ProgressBar.h"
#include "io/ImportSamples.h"

#include <iostream>
#include <memory>
#include <optional>

namespace palp {

namespace {

struct ImportArguments {
  std::string table;
  std::string map;
  std::string design;
  OutputFile output;
};

Exit run(const ImportArguments& arguments, Session& session) {
  arguments.output.requireWritable();
  std::optional<SensorDesign> design;
  if (!arguments.design.empty()) design = designOption(arguments.design);
  ProgressBar bar("importing", 1000);
  const Imported imported = importSamples(
      arguments.table, arguments.map, design ? &*design : nullptr, arguments.output.path, arguments.output.force,
      [&](double share) { bar.show(static_cast<std::size_t>(1000 * share)); }, session.stop);
  session.result["samples"] = imported.samples;
  session.result["unused_columns"] = imported.unusedColumns;
  session.result["design"] = imported.design;
  session.result["file"] = arguments.output.path.string();
  if (!imported.constant.empty()) {
    std::cerr << "palp import: " << imported.constant << '\n';
    session.warnings.push_back(imported.constant);
  }
  if (!session.json)
    std::cout << imported.samples << " samples of design " << imported.design << " in "
              << arguments.output.path.string() << "; " << imported.unusedColumns << " columns of the table not used\n";
  return Exit::Done;
}

} // namespace

void addImport(Cli& cli) {
  auto arguments = std::make_shared<ImportArguments>();
  Command command =
      cli.command("import", "Converts measured data of another rig to samples, by a map of the columns of its table.",
                  "palp import table.csv --map map.json -o samples.h5",
                  [arguments](Session& session) { return run(*arguments, session); });
  command.option("table", arguments->table, "FILE", "CSV with a line of column names, or NPZ with a row per sample")
      .required();
  command.group("Input");
  command
      .option("--map", arguments->map, "FILE",
              "JSON file: which columns are resistances, forces, areas or positions, and time; their units")
      .required();
  command.option("--design", arguments->design, "DESIGN",
                 "design of the measured sensor: a file, or paper (default: unknown)");
  arguments->output.declare(command, "sample file to write: .csv, .h5 or .npz").required();
}

} // namespace palp
