#include "app/study/cluster/ClusterJob.h"

#include "app/study/ChildProcess.h"
#include "io/AtomicFile.h"
#include "io/StrictJson.h"
#include "io/StudyFile.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr double kFewSamples = 32, kSomeSamples = 96; // one batch of the solver, and three
constexpr double kTimeMargin = 2;                     // of the limit over what is expected: nodes differ
constexpr double kSpareTime_s = 300;
constexpr double kMemoryMargin = 1.3, kSpareMemory_MB = 200;
constexpr double kMostMeasured_s = 24 * 3600;

/// A word for the shell.
std::string quoted(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("-_./,:=@+*").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain && word.find('*') == std::string::npos) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string commandOf(const ClusterJob& job) {
  std::string words = quoted(job.program.string()) + " " + job.kind;
  for (const std::string& argument : job.arguments) words += " " + quoted(argument);
  return words;
}

std::string extensionOf(const ClusterJob& job) {
  return job.kind == "study" ? "" : job.output.extension().string();
}

/// Runs a line of the shell where the job's paths begin; gives what it printed.
ChildRun shell(const ClusterJob& job, const std::string& line, const std::stop_token& stop) {
  const ScratchFolder scratch;
  ChildOrder order;
  order.program = "/bin/sh";
  order.arguments = {"-c", "cd " + quoted(job.workFolder.string()) + " && exec " + line};
  order.folder = scratch.path();
  order.limit_s = kMostMeasured_s;
  ChildRun run = runChild(order, stop);
  if (stop.stop_requested()) throw Cancelled();
  return run;
}

struct MeasuredShard {
  double samples = 0, all = 0, seconds = 0, memory_MB = 0;
};

MeasuredShard measuredSamples(const ClusterJob& job, int parts, const std::stop_token& stop) {
  const ScratchFolder scratch;
  const std::string out = (scratch.path() / ("first" + extensionOf(job))).string();
  const ChildRun run = shell(job,
                             commandOf(job) + " --threads " + std::to_string(job.cpus) + " --shard 1/" +
                                 std::to_string(parts) + " --json -o " + quoted(out),
                             stop);
  if (!run.failed.empty()) throw Error(run.failed);
  const Json json = parseJson(run.output, "palp sample --json");
  return {json.at("samples").get<double>(), json.at("samples_of_all_shards").get<double>(), run.seconds, run.peak_MB};
}

std::string asTime(double seconds) {
  const auto minutes = static_cast<long>(std::ceil((kTimeMargin * seconds + kSpareTime_s) / 60));
  std::string rest = std::to_string(minutes % 60);
  if (rest.size() < 2) rest.insert(0, "0");
  return std::to_string(minutes / 60) + ":" + rest + ":00";
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

fs::path doneMark(const ClusterJob& job, int shard) {
  return job.folder / "done" / std::to_string(shard);
}

} // namespace

void measure(ClusterJob& job, const std::stop_token& stop) {
  if (job.kind == "study") {
    const ScratchFolder scratch;
    const StudyPlan plan = loadStudy(job.workFolder / job.arguments.at(0));
    const std::size_t designs = plan.designs();
    if (static_cast<std::size_t>(job.shards) > designs)
      throw Error("--shards: " + std::to_string(job.shards) + "; allowed is at most the study's " +
                  std::to_string(designs) + " designs");
    const ChildRun run =
        shell(job,
              commandOf(job) + " --threads " + std::to_string(job.cpus) + " --shard 1/" + std::to_string(designs) +
                  " --json -o " + quoted((scratch.path() / "first").string()),
              stop);
    if (!run.failed.empty()) throw Error(run.failed);
    job.secondsAShard = run.seconds * std::ceil(static_cast<double>(designs) / job.shards);
    job.memory_MB = run.peak_MB;
    return;
  }
  // A shard begins with mesh, factorisation and predictors, which two sizes tell apart from its samples.
  const double all = measuredSamples(job, 1'000'000, stop).all; // of no sample
  const auto first = [&](double samples) {
    return measuredSamples(job, std::max(1, static_cast<int>(all / std::min(all, samples))), stop);
  };
  const MeasuredShard few = first(kFewSamples), some = first(kSomeSamples);
  const double each_s =
      some.samples > few.samples ? std::max(0., some.seconds - few.seconds) / (some.samples - few.samples) : 0;
  const double before_s = std::max(0., few.seconds - each_s * few.samples);
  job.secondsAShard = before_s + each_s * std::ceil(all / job.shards);
  job.memory_MB = some.memory_MB;
}

std::map<std::string, std::string> clusterScripts(const ClusterJob& job) {
  const std::string folder = quoted(job.folder.string()), all = std::to_string(job.shards);
  const bool study = job.kind == "study";
  const std::string part =
      study ? quoted(job.output.string()) : quoted((job.folder / "shards").string()) + "/$n" + extensionOf(job);
  std::map<std::string, std::string> scripts;
  scripts["shard.sh"] = "#!/bin/sh\n"
                        "# One shard of " +
                        all +
                        ", number $1: nothing where it is done; one that was ended goes on.\n"
                        "n=$1\n"
                        "cd " +
                        quoted(job.workFolder.string()) +
                        " || exit 1\n"
                        "[ -e " +
                        folder + "/done/$n ] && exit 0\n" + commandOf(job) + " --threads ${SLURM_CPUS_PER_TASK:-" +
                        std::to_string(job.cpus) + "} --shard $n/" + all + " -o " + part + (study ? "" : " --force") +
                        "\n"
                        "status=$?\n"
                        "if [ $status -eq 0 ]; then\n"
                        "  rm -f " +
                        folder + "/failed/$n && touch " + folder +
                        "/done/$n\n"
                        "else\n"
                        "  echo $status > " +
                        folder +
                        "/failed/$n\n"
                        "fi\n"
                        "exit $status\n";
  std::string merge;
  if (study)
    merge = commandOf(job) + " -o " + part + "\n";
  else {
    merge = quoted(job.program.string()) + " merge";
    for (int n = 1; n <= job.shards; ++n)
      merge += " \\\n  " + quoted((job.folder / "shards" / (std::to_string(n) + extensionOf(job))).string());
    merge += " \\\n  -o " + quoted(job.output.string()) + " --force\n";
  }
  scripts["merge.sh"] = "#!/bin/sh\n"
                        "# All shards into " +
                        job.output.string() +
                        ".\n"
                        "cd " +
                        quoted(job.workFolder.string()) + " || exit 1\n" + merge +
                        "status=$?\n[ $status -eq 0 ] && touch " + folder + "/done/merge\nexit $status\n";
  const auto sbatch = [&](const std::string& name, const std::string& more, const std::string& log) {
    return "#!/bin/sh\n#SBATCH --job-name=palp-" + name + "\n" + more +
           "#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --output=" + (job.folder / "logs" / log).string() +
           "\n";
  };
  const long memory = static_cast<long>(std::ceil(kMemoryMargin * job.memory_MB + kSpareMemory_MB));
  scripts["array.sbatch"] =
      sbatch(job.kind,
             "#SBATCH --array=1-" + all + "\n#SBATCH --cpus-per-task=" + std::to_string(job.cpus) +
                 "\n#SBATCH --mem=" + std::to_string(memory) + "M\n#SBATCH --time=" + asTime(job.secondsAShard) + "\n",
             "%a.txt") +
      "# MeasuredShard: " + text(std::round(10 * job.secondsAShard) / 10) + " s a shard, " +
      text(std::round(job.memory_MB)) + " MB; the limits leave room for slower nodes.\n" + folder +
      "/shard.sh \"$SLURM_ARRAY_TASK_ID\"\n"
      "status=$?\n"
      "# Killed (memory, a node in trouble): again, three times at most, and on from what was made.\n"
      "[ $status -gt 128 ] && [ \"${SLURM_RESTART_COUNT:-0}\" -lt 3 ] && scontrol requeue \"$SLURM_JOB_ID\"\n"
      "exit $status\n";
  scripts["merge.sbatch"] = sbatch("merge",
                                   "#SBATCH --cpus-per-task=" + std::to_string(job.cpus) +
                                       "\n#SBATCH --mem=" + std::to_string(std::max(1000L, memory)) +
                                       "M\n#SBATCH --time=" + asTime(3600) + "\n",
                                   "merge.txt") +
                            "exec " + folder + "/merge.sh\n";
  scripts["here.sh"] =
      "#!/bin/sh\n"
      "# All shards on this machine by GNU parallel, as many at a time as $1 says (1), then the merge.\n"
      "parallel --jobs \"${1:-1}\" " +
      folder + "/shard.sh {} ::: $(seq " + all + ") && exec " + folder + "/merge.sh\n";
  return scripts;
}

void writeJob(const ClusterJob& job) {
  if (fs::exists(job.folder))
    throw Error(job.folder.string() + ": is there already; palp cluster status " + job.folder.string() +
                " says how it stands; allowed is a new folder");
  std::error_code failed;
  for (const char* part : {"shards", "done", "failed", "logs"}) {
    fs::create_directories(job.folder / part, failed);
    if (failed) throw Error((job.folder / part).string() + ": the folder cannot be made: " + failed.message());
  }
  for (const auto& [name, content] : clusterScripts(job)) {
    writeFile(job.folder / name, content, true);
    fs::permissions(job.folder / name, fs::perms::owner_exec | fs::perms::group_exec, fs::perm_options::add);
  }
  const Json json{{"palp_cluster", 1},
                  {"kind", job.kind},
                  {"arguments", job.arguments},
                  {"output", job.output.string()},
                  {"shards", job.shards},
                  {"cpus", job.cpus},
                  {"work_folder", job.workFolder.string()},
                  {"program", job.program.string()},
                  {"seconds_a_shard", job.secondsAShard},
                  {"memory_MB", job.memory_MB}};
  writeFile(job.folder / "job.json", json.dump(1) + "\n", true);
}

ClusterJob readJob(const fs::path& folder) {
  const fs::path file = folder / "job.json";
  if (!fs::exists(file))
    throw Error(folder.string() +
                ": no job.json in it; allowed is a folder that palp cluster sample or study has made");
  const Json json = parseJson(readFile(file), file.string());
  const JsonPlace root(json, file.string());
  formatVersion(root, "palp_cluster", 1);
  root.onlyKeys({"palp_cluster", "kind", "arguments", "output", "shards", "cpus", "work_folder", "program",
                 "seconds_a_shard", "memory_MB"});
  ClusterJob job;
  job.kind = root.at("kind").string();
  if (job.kind != "sample" && job.kind != "study") root.at("kind").refuse("sample or study");
  for (const JsonPlace& argument : root.at("arguments").list()) job.arguments.push_back(argument.string());
  job.output = root.at("output").string();
  job.shards = root.at("shards").integer(1, 100'000);
  job.cpus = root.at("cpus").integer(1, 4096);
  job.workFolder = root.at("work_folder").string();
  job.program = root.at("program").string();
  job.secondsAShard = root.at("seconds_a_shard").number();
  job.memory_MB = root.at("memory_MB").number();
  job.folder = fs::absolute(folder).lexically_normal();
  return job;
}

ClusterStatus statusOf(const ClusterJob& job, const std::stop_token& stop) {
  ClusterStatus status;
  status.shards.assign(static_cast<std::size_t>(job.shards), ShardState::Missing);
  status.merged = fs::exists(job.folder / "done" / "merge");
  if (programInPath("squeue") && fs::exists(job.folder / "slurm.txt")) {
    std::string ids;
    for (const std::string& id : linesOf(readFile(job.folder / "slurm.txt"))) ids += (ids.empty() ? "" : ",") + id;
    const ChildRun run = shell(job, "squeue --noheader --array --jobs=" + ids + " --format='%K %t'", stop);
    status.slurm = run.failed.empty(); // it refuses numbers that it has long forgotten
    for (const std::string& line : linesOf(run.output)) {
      std::istringstream words(line);
      int shard = 0;
      std::string state;
      if (!(words >> shard >> state) || shard < 1 || shard > job.shards) continue; // the merge has no number
      status.shards[static_cast<std::size_t>(shard - 1)] =
          state == "PD" || state == "RQ" || state == "RH" ? ShardState::Waiting : ShardState::Running;
    }
  }
  for (int n = 1; n <= job.shards; ++n) {
    ShardState& state = status.shards[static_cast<std::size_t>(n - 1)];
    if (fs::exists(doneMark(job, n)))
      state = ShardState::Done;
    else if (const fs::path failed = job.folder / "failed" / std::to_string(n);
             state == ShardState::Missing && fs::exists(failed)) {
      state = ShardState::Failed;
      std::string code = readFile(failed);
      code.erase(std::remove(code.begin(), code.end(), '\n'), code.end());
      status.failures.push_back("shard " + std::to_string(n) + " ended with status " + code + ": " +
                                (job.folder / "logs" / (std::to_string(n) + ".txt")).string());
    }
  }
  return status;
}

std::string submit(const ClusterJob& job, const std::vector<int>& shards, const std::stop_token& stop) {
  if (!programInPath("sbatch"))
    throw Error("sbatch: not in the PATH; allowed is a machine with Slurm, or " + (job.folder / "here.sh").string() +
                " with GNU parallel");
  std::string numbers;
  for (const int n : shards) numbers += (numbers.empty() ? "" : ",") + std::to_string(n);
  const auto hand = [&](const std::string& what) {
    const ChildRun run = shell(job, "sbatch --parsable " + what, stop);
    if (!run.failed.empty()) throw Error("sbatch: " + run.failed);
    return run.output.substr(0, run.output.find_first_of(";\n"));
  };
  std::string after;
  if (!shards.empty()) after = hand("--array=" + numbers + " " + quoted((job.folder / "array.sbatch").string()));
  hand((after.empty() ? "" : "--dependency=afterok:" + after + " ") + quoted((job.folder / "merge.sbatch").string()));
  const fs::path known = job.folder / "slurm.txt"; // numbers of all arrays
  if (!after.empty()) writeFile(known, (fs::exists(known) ? readFile(known) : "") + after + "\n", true);
  return after;
}

} // namespace palp
