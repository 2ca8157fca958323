#include "app/cli/Cli.h"
#include "app/cli/Options.h"
#include "app/study/cluster/ClusterJob.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <iostream>
#include <memory>

namespace palp {

namespace {

struct ClusterArguments {
  std::string what;
  std::vector<std::string> rest; ///< the command's own
  std::string shards, cpus = "2", sbatch;
  std::filesystem::path folder;
  bool submit = false, dryRun = false, resubmit = false;
};

constexpr std::array kStateNames{"unknown", "missing", "waiting", "running", "failed", "done"};

/// Takes the output out of the command's arguments.
std::filesystem::path outputOf(std::vector<std::string>& arguments, const std::string& kind) {
  constexpr std::string_view kGlued = "--output=";
  for (auto word = arguments.begin(); word != arguments.end(); ++word) {
    const bool glued = word->starts_with(kGlued);
    if (!glued && ((*word != "-o" && *word != "--output") || word + 1 == arguments.end())) continue;
    const std::filesystem::path output = glued ? word->substr(kGlued.size()) : *(word + 1);
    requireNoStream("-o", output);
    arguments.erase(word, word + (glued ? 1 : 2));
    return output;
  }
  throw UsageError("-o is missing; give the " + std::string(kind == "sample" ? "sample file" : "folder of the study") +
                   " to write");
}

/// Options of sbatch alone, in one line: a shell would interpret anything else.
std::string slurmOptions(const std::string& typed) {
  constexpr std::string_view kPlain = "-_./,:=@+%~*[] ";
  const bool plain = std::all_of(typed.begin(), typed.end(), [&](unsigned char c) {
    return std::isalnum(c) != 0 || kPlain.find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (!typed.empty() && (!plain || typed[0] != '-'))
    throw badValue("--sbatch", typed, "options of sbatch, for example --partition=short --account=lab");
  for (const char* ours : {"--array", "--output", "--dependency", "--wrap"})
    if (typed.find(ours) != std::string::npos)
      throw UsageError("--sbatch: " + gotExpected(ours, "other options of sbatch; palp sets this one for each job"));
  return typed;
}

ClusterJob jobOf(const ClusterArguments& arguments) {
  ClusterJob job;
  job.kind = arguments.what;
  if (arguments.shards.empty()) throw UsageError("--shards is missing; give the number of parts");
  job.shards = wholeNumber("--shards", arguments.shards, 1, 100'000);
  job.sbatch = slurmOptions(arguments.sbatch);
  job.cpus = wholeNumber("--cpus", arguments.cpus, 1, 4096);
  job.arguments = arguments.rest;
  for (const char* name : {"--shard", "--threads"})
    if (std::find(job.arguments.begin(), job.arguments.end(), name) != job.arguments.end())
      throw UsageError("palp cluster sets " + std::string(name) + " for each shard; expected other options of palp " +
                       job.kind);
  job.output = std::filesystem::absolute(outputOf(job.arguments, job.kind));
  if (job.arguments.empty())
    throw UsageError("palp cluster " + job.kind + ": the " + (job.kind == "sample" ? "design" : "study file") +
                     " is missing");
  const std::filesystem::path folder =
      arguments.folder.empty() ? std::filesystem::path("palp-cluster-" + job.kind) : arguments.folder;
  job.folder = std::filesystem::absolute(folder).lexically_normal();
  job.workFolder = std::filesystem::current_path();
  job.program = std::filesystem::read_symlink("/proc/self/exe");
  return job;
}

Exit make(const ClusterArguments& arguments, Session& session) {
  ClusterJob job = jobOf(arguments);
  if (!arguments.dryRun) requireRoom(job); // refuses before it measures
  if (arguments.submit && !arguments.dryRun) requireAccepted(job, session.stop);
  if (!session.json) std::cerr << "measuring the first " << (job.kind == "sample" ? "samples" : "design") << "\n";
  measure(job, session.stop);
  session.result["shards"] = job.shards;
  session.result["seconds_a_shard"] = job.secondsAShard;
  session.result["memory_MB"] = job.memory_MB;
  session.result["folder"] = job.folder.string();
  if (arguments.dryRun) {
    for (const auto& [name, content] : clusterScripts(job)) {
      session.result["scripts"][name] = content;
      if (!session.json) std::cout << "== " << (job.folder / name).string() << "\n" << content;
    }
    return Exit::Done;
  }
  writeJob(job);
  std::string next = "submit with --submit, or run here: " + (job.folder / "here.sh").string();
  if (arguments.submit) {
    std::vector<int> all;
    for (int n = 1; n <= job.shards; ++n) all.push_back(n);
    const std::string id = submit(job, all, {}, session.stop);
    session.result["job"] = id;
    next = "submitted to Slurm as job " + id;
  }
  if (!session.json)
    std::cout << job.shards << " shards of about " << text(std::round(job.secondsAShard)) << " s and "
              << text(std::round(job.memory_MB)) << " MB in " << job.folder.string() << "; " << next << '\n';
  return Exit::Done;
}

Exit status(const ClusterArguments& arguments, Session& session) {
  if (arguments.rest.size() != 1)
    throw UsageError("status: " + gotExpected(std::to_string(arguments.rest.size()) + " folders",
                                              "one: palp cluster status FOLDER"));
  const ClusterJob job = readJob(arguments.rest[0]);
  const ClusterStatus found = statusOf(job, session.stop);
  std::array<int, kStateNames.size()> counts{};
  std::vector<int> again;
  for (std::size_t n = 0; n < found.shards.size(); ++n) {
    ++counts[static_cast<std::size_t>(found.shards[n])];
    if (found.shards[n] == ShardState::Failed || found.shards[n] == ShardState::Missing)
      again.push_back(static_cast<int>(n) + 1);
  }
  std::string words = std::to_string(job.shards) + " shards:";
  const std::size_t last = found.queueFailed.empty() ? 1 : 0; // unknown is nothing where the queue answers
  for (std::size_t s = kStateNames.size(); s-- > last;) {
    session.result[kStateNames[s]] = counts[s];
    words += " " + std::to_string(counts[s]) + " " + kStateNames[s] + (s > last ? "," : "");
  }
  session.result["merged"] = found.merged;
  session.result["failures"] = found.failures;
  if (!session.json) {
    std::cout << words << "; " << (found.merged ? "merged into " + job.output.string() : "not merged") << '\n';
    for (const std::string& failure : found.failures) std::cout << failure << '\n';
  }
  if (!found.queueFailed.empty()) {
    session.result["stop_reason"] = found.queueFailed;
    std::cerr << "palp cluster: " << found.queueFailed << (arguments.resubmit ? "; nothing was submitted" : "") << '\n';
    return Exit::NoResult;
  }
  if (!arguments.resubmit) return Exit::Done;
  if (again.empty() && (found.merged || found.merging)) {
    if (!session.json) std::cout << "nothing to submit again\n";
    return Exit::Done;
  }
  const std::string id = submit(job, again, found, session.stop);
  session.result["job"] = id;
  session.result["submitted"] = again;
  const std::string shards = again.size() == 1 ? "1 shard" : std::to_string(again.size()) + " shards";
  if (!session.json) std::cout << (again.empty() ? "" : shards + " and ") << "the merge submitted again\n";
  return Exit::Done;
}

Exit run(const ClusterArguments& arguments, Session& session) {
  if (arguments.what == "status") return status(arguments, session);
  if (arguments.resubmit) throw UsageError("--resubmit: only with palp cluster status FOLDER");
  return make(arguments, session);
}

} // namespace

void addCluster(Cli& cli) {
  auto arguments = std::make_shared<ClusterArguments>();
  Command command =
      cli.command("cluster", "Computes samples and studies in shards, by Slurm job arrays or GNU parallel.",
                  "palp cluster sample sensor.json --per-area 1000 -o samples.h5 --shards 20 --submit",
                  [arguments](Session& session) { return run(*arguments, session); });
  command
      .option("what", arguments->what, "TEXT",
              "sample or study, followed by the arguments of that command; or status FOLDER for the progress of a job")
      .required()
      .oneOf({"sample", "study", "status"});
  command.group("Job");
  command.option("--shards", arguments->shards, "N", "number of parts");
  command.option("--cpus", arguments->cpus, "N", "processors per shard (default 2)");
  command.option("--folder", arguments->folder, "FOLDER",
                 "folder for scripts, shards and messages (default palp-cluster-sample or palp-cluster-study)");
  command.option("--sbatch", arguments->sbatch, "TEXT",
                 "further options of Slurm's sbatch for all jobs: \"--partition=short --account=lab\"");
  command.flag("--submit", arguments->submit, "submit the job to Slurm");
  command.flag("--dry-run", arguments->dryRun, "measure and print the scripts, write nothing");
  command.flag("--resubmit", arguments->resubmit, "with status: submit failed and missing shards again");
  command.rest(arguments->rest);
}

} // namespace palp
