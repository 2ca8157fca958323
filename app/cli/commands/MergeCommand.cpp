#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "io/SampleFile.h"

#include <iostream>
#include <memory>

namespace palp {

namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  OutputFile output;
};

Exit run(const MergeArguments& arguments, Session& session) {
  arguments.output.requireWritable();
  const auto [samples, warning] = mergeSampleFiles({arguments.parts.begin(), arguments.parts.end()},
                                                   arguments.output.path, arguments.output.force, session.stop);
  if (!warning.empty()) {
    session.warnings.push_back(warning);
    std::cerr << "palp merge: " << warning << '\n';
  }
  session.result["samples"] = samples;
  session.result["solves"] = 0;
  session.result["solves_per_s"] = 0;
  session.result["file"] = arguments.output.path.string();
  if (!session.json) std::cout << samples << " samples in " << arguments.output.path.string() << '\n';
  return Exit::Done;
}

} // namespace

void addMerge(Cli& cli) {
  auto arguments = std::make_shared<MergeArguments>();
  Command command = cli.command(
      "merge", "Joins the shards of a sample file to the result of one run, or measured sets of one rig as runs.",
      "palp merge part1.csv part2.csv -o samples.csv",
      [arguments](Session& session) { return run(*arguments, session); });
  command.option("parts", arguments->parts, "FILE", "sample files of all shards; one complete file is only rewritten")
      .required();
  arguments->output.declare(command, "sample file to write: .csv, .h5 or .npz").required();
}

} // namespace palp
