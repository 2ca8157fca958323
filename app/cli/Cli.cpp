#include "app/cli/Cli.h"

#include "app/cli/Interrupt.h"
#include "app/study/Blas.h"
#include "app/study/Failure.h"
#include "app/study/Resources.h"
#include "app/study/Version.h"
#include "app/study/reports/ProcessMemory.h"
#include "io/StrictJson.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "solver/BatchSolver.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

namespace palp {

namespace {

/// CLI11 breaks some messages over lines; ours are one.
std::string oneLine(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

nlohmann::ordered_json toJson(const StageLog& stages) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const auto& [stage, count] : stages.counts()) json[stage] = {{"runs", count.runs}, {"seconds", count.seconds}};
  return json;
}

/// Where to read on; nothing where the pages were not installed.
std::string pagesInWords() {
  try {
    return "Pages: " + resource("docs/architecture.md").parent_path().string() +
           "\n  guide.md        a first hour, from an empty folder to a calibrated recording"
           "\n  architecture.md how the parts fit together, how to add a command, a scene, a decoder or a report"
           "\n  physics.md      the sensor, its equations, what can be compared with the paper"
           "\n  validation.md   accuracy and speed with their commands, what is supported, limits"
           "\n  numerics/       elements, solver, networks, bounds: formulas and their sources"
           "\n  formats.md      every file, with an example"
           "\n  notebooks.md    samples in h5py, NumPy and pandas"
           "\n  live-forces.md  live forces in other programs, with receivers"
           "\n  clusters.md     studies of many designs, and Slurm"
           "\n  glossary.md, environment.md, contributing.md, changelog.md";
  } catch (const Error&) {
    return {};
  }
}

/// Letters that are inserted, left out or exchanged between both words (Wagner and Fischer, 1974).
std::size_t editsBetween(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t exchanged = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, exchanged});
    }
  }
  return row.back();
}

std::vector<std::string> knownWords(const CLI::App& command, bool option) {
  std::vector<std::string> words;
  if (option) {
    for (const CLI::Option* known : command.get_options())
      for (const std::string& name : known->get_lnames()) words.push_back("--" + name);
  } else {
    for (const CLI::App* known : command.get_subcommands([](const CLI::App*) { return true; }))
      words.push_back(known->get_name());
  }
  return words;
}

/// What a command line has that `command` does not know, with the nearest word that it does know:
/// "'--chek' is not expected here; did you mean --check?".
std::string unexpectedInWords(const CLI::App& command) {
  const std::vector<std::string> left = command.remaining();
  if (left.empty()) return {};
  const std::string word = left.front().substr(0, left.front().find('='));
  std::string words = "'" + word + "' is not expected here";
  const std::vector<std::string> known = knownWords(command, word.starts_with('-'));
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return editsBetween(word, a) < editsBetween(word, b);
  });
  if (nearest != known.end() && 3 * editsBetween(word, *nearest) <= word.size())
    words += "; did you mean " + *nearest + "?";
  return words;
}

} // namespace

Cli::Cli()
    : app_(std::make_unique<CLI::App>(
          "Palp: three-axis tactile sensors of conductive rubber, from the block to the force", "palp")) {
  app_->require_subcommand(0, 1);
  app_->footer(pagesInWords);
  app_->set_version_flag("--version", versionInWords);
  app_->fallthrough(false);
}

Cli::~Cli() = default;

Command Cli::command(const std::string& name, const std::string& what, const std::string& example, Run run) {
  CLI::App* added = app_->add_subcommand(name, what);
  added->footer("Example: " + example);
  commands_.emplace_back(added, std::move(run));
  return Command(added);
}

/// Of every command, below its own options.
void Cli::addGeneralOptions() {
  for (const auto& [command, run] : commands_) {
    command->option_defaults()->group("General");
    command
        ->add_option("--threads", session_.threads,
                     "number of threads; changes the time, never the result (default: all cores)")
        ->check(CLI::Range(1, 4096))
        ->type_name("N");
    command->add_flag("--json", session_.json, "print one JSON object on standard output and nothing else");
    command->set_help_flag("-h,--help", "print this help and exit");
  }
}

int Cli::main(int argc, char** argv) {
  addGeneralOptions();
  try {
    app_->parse(argc, argv);
  } catch (const CLI::Success& asked) { // help, version
    return app_->exit(asked);
  } catch (const CLI::ParseError& wrong) {
    const auto chosen = app_->get_subcommands();
    const std::string unexpected = dynamic_cast<const CLI::ExtrasError*>(&wrong) != nullptr
                                       ? unexpectedInWords(chosen.empty() ? *app_ : *chosen[0])
                                       : std::string();
    std::cerr << "palp" << (chosen.empty() ? "" : " " + chosen[0]->get_name()) << ": "
              << (unexpected.empty() ? oneLine(wrong.what()) : unexpected) << " (see palp"
              << (chosen.empty() ? "" : " " + chosen[0]->get_name()) << " --help)\n";
    return static_cast<int>(Exit::BadInput);
  }
  if (app_->get_subcommands().empty()) {
    std::cout << app_->help();
    return static_cast<int>(Exit::Done);
  }
  return static_cast<int>(runChosen());
}

Exit Cli::runChosen() {
  const CLI::App* chosen = app_->get_subcommands()[0];
  const std::string name = chosen->get_name();
  const auto run = std::find_if(commands_.begin(), commands_.end(), [&](const auto& c) { return c.first == chosen; });
  const Interrupt interrupt; // Ctrl-C becomes a stop request
  session_.stop = interrupt.token();
  if (session_.threads == 0) session_.threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (auto slow = slowBlas()) {
    session_.warnings.push_back(*slow);
    std::cerr << "palp: " << *slow << '\n';
  }
  session_.result["command"] = name;
  session_.result["version"] = version();
  Exit exit = Exit::Done;
  try {
    exit = run->second(session_);
  } catch (const ConvergenceError& stopped) { // an outcome, not a refusal: the JSON has how far it came
    std::cerr << "palp " << name << ": " << oneLine(stopped.what()) << '\n';
    session_.result["stop_reason"] = stopped.what();
    exit = Exit::NoResult;
  } catch (const Error& refused) {
    std::cerr << "palp " << name << ": " << oneLine(refused.what()) << '\n';
    return Exit::BadInput;
  } catch (const std::filesystem::filesystem_error& unreached) {
    std::cerr << "palp " << name << ": " << fileFailureInWords(unreached) << '\n';
    return Exit::BadInput;
  } catch (const Cancelled&) { // where a command had nothing of its own to say
    std::cerr << "palp " << name << ": stopped before a result was available\n";
    exit = Exit::NoResult;
  } catch (const std::bad_alloc&) {
    std::cerr << "palp " << name << ": not enough memory for this size; choose a coarser mesh or fewer samples\n";
    session_.result["stop_reason"] = "not enough memory";
    exit = Exit::NoResult;
  }
  session_.result["warnings"] = session_.warnings;
  session_.result["peak_memory_MB"] = peakMemory_MB();
  session_.result["stages"] = toJson(session_.stages);
  if (session_.json) std::cout << jsonText(session_.result, session_.indent) << '\n';
  if (!std::cout.flush() || std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
    std::cerr << "palp " << name << ": standard output: cannot be written: " << std::strerror(errno) // NOLINT
              << '\n';
    return Exit::BadInput;
  }
  return interrupt.token().stop_requested() ? Exit::Interrupted : exit;
}

} // namespace palp
