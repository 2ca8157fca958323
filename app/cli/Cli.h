#pragma once

#include "app/cli/Command.h"
#include "app/study/StageLog.h"
#include "model/base/Error.h"

#include <nlohmann/json.hpp>

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Exit status of every command.
enum class Exit { Done = 0, NoResult = 1, BadInput = 2, Interrupted = 130 };

/// A bad option; the text is one line, "--option: got 'value', expected ...".
struct UsageError : Error {
  using Error::Error;
};

/// What a running command has in addition to its own options. It fills `result` (the JSON object) and writes words to
/// standard output only where `json` is false.
struct Session {
  bool json = false;
  int threads = 0; ///< 0: all cores
  std::stop_token stop;
  int indent = 2; ///< of the JSON; -1: all in one line
  nlohmann::ordered_json result = nlohmann::ordered_json::object();
  std::vector<std::string> warnings;
  StageLog stages;
};

/// Collects the commands; each addX declares its options and what runs when it is chosen.
class Cli {
public:
  using Run = std::function<Exit(Session&)>;

  Cli();
  ~Cli();
  Cli(const Cli&) = delete;
  Cli& operator=(const Cli&) = delete;
  /// Adds a command; its options are declared on what is returned. `what` is a sentence, `example` a command line.
  Command command(const std::string& name, const std::string& what, const std::string& example, Run run);
  /// Parses and runs; the process's exit status.
  int main(int argc, char** argv);

private:
  void addGeneralOptions();
  Exit runChosen();

  std::unique_ptr<CLI::App> app_;
  std::vector<std::pair<CLI::App*, Run>> commands_;
  Session session_;
};

void addDesign(Cli& cli);
void addMaterial(Cli& cli);
void addMesh(Cli& cli);
void addSolve(Cli& cli);
void addRender(Cli& cli);
void addSample(Cli& cli);
void addStudy(Cli& cli);
void addCluster(Cli& cli);
void addImport(Cli& cli);
void addMerge(Cli& cli);
void addReproduce(Cli& cli);
void addReport(Cli& cli);
void addTrain(Cli& cli);
void addPredict(Cli& cli);
void addSweep(Cli& cli);
void addListen(Cli& cli);
void addCalibrate(Cli& cli);

} // namespace palp
