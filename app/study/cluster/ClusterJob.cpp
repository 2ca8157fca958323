#include "app/study/cluster/ClusterJob.h"

#include "app/study/ChildProcess.h"
#include "app/study/cluster/ShellWords.h"
#include "app/study/studies/StudyFolder.h"
#include "io/AtomicFile.h"
#include "io/StrictJson.h"
#include "io/StudyFile.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <sstream>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr double kFewSamples = 32, kSomeSamples = 96;              // one batch of the solver, and three
constexpr double kMostMeasured_s = 24 * 3600, kMostQueried_s = 60; // Slurm's commands give up on their own before
constexpr const char* kSlurmNumbers = "slurm.txt";                 // of arrays, and with this mark of merges
constexpr const char* kMergeMark = "merge ";
constexpr const char* kLatin1 = "latin-1"; // of a job.json with names that are not UTF-8: a letter a byte

/// Runs a line of the shell where the job's paths begin; gives what it printed.
ChildRun shell(const ClusterJob& job, const std::string& line, double limit_s, const std::stop_token& stop) {
  const ScratchFolder scratch;
  ChildOrder order;
  order.program = "/bin/sh";
  order.arguments = {"-c", "cd " + shellWord(job.workFolder.string()) + " && exec " + line};
  order.folder = scratch.path();
  order.limit_s = limit_s;
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
                                 std::to_string(parts) + " --json -o " + shellWord(out),
                             kMostMeasured_s, stop);
  if (!run.failed.empty()) throw Error(run.failed);
  const Json json = parseJson(run.output, "palp sample --json");
  return {json.at("samples").get<double>(), json.at("samples_of_all_shards").get<double>(), run.seconds, run.peak_MB};
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// A command of Slurm's.
ChildRun slurm(const ClusterJob& job, const std::string& line, const std::stop_token& stop) {
  return shell(job, line, kMostQueried_s, stop);
}

void requireSbatch(const ClusterJob& job) {
  if (!programInPath("sbatch"))
    throw Error("sbatch: not in the PATH; expected a machine with Slurm, or run " + (job.folder / "here.sh").string() +
                " with GNU parallel");
}

/// Slurm's MaxArraySize, which is above the largest number of a task; nothing where it does not say it.
std::optional<int> largestArray(const ClusterJob& job, const std::stop_token& stop) {
  if (!programInPath("scontrol")) return {};
  for (const std::string& line : linesOf(slurm(job, "scontrol show config", stop).output)) {
    std::istringstream words(line);
    std::string key, equals;
    int value = 0;
    if (words >> key >> equals >> value && key == "MaxArraySize") return value;
  }
  return {};
}

/// The text where every string of it is UTF-8, as JSON requires.
std::optional<std::string> asUtf8(const Json& json) {
  try {
    return json.dump(1);
  } catch (const Json::type_error&) {
    return {};
  }
}

/// Each byte as one letter of Latin-1, in UTF-8, and back: for names of files that are not UTF-8.
std::string fromLatin1(const std::string& bytes) {
  std::string text;
  for (const unsigned char c : bytes) {
    if (c >= 0x80) text += static_cast<char>(0xc0 | (c >> 6U));
    text += static_cast<char>(c < 0x80 ? c : 0x80 | (c & 0x3fU));
  }
  return text;
}

std::string toLatin1(const std::string& text) {
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    const bool two = c >= 0xc0 && i + 1 < text.size();
    bytes += two ? static_cast<char>((c << 6U) | (static_cast<unsigned char>(text[++i]) & 0x3fU)) : text[i];
  }
  return bytes;
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
      throw Error("--shards: " + gotExpected(std::to_string(job.shards),
                                             "at most " + std::to_string(designs) + ", the designs of the study"));
    const ChildRun run =
        shell(job,
              commandOf(job) + " --threads " + std::to_string(job.cpus) + " --shard 1/" + std::to_string(designs) +
                  " --json -o " + shellWord((scratch.path() / "first").string()),
              kMostMeasured_s, stop);
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

void requireAccepted(const ClusterJob& job, const std::stop_token& stop) {
  requireSbatch(job);
  if (const auto most = largestArray(job, stop); most && job.shards >= *most)
    throw Error("--shards: " + gotExpected(std::to_string(job.shards),
                                           "at most " + std::to_string(*most - 1) + " on this cluster (MaxArraySize " +
                                               std::to_string(*most) + " of scontrol show config)"));
  const ChildRun run = slurm(job,
                             "sbatch --test-only --array=1-" + std::to_string(job.shards) +
                                 " --cpus-per-task=" + std::to_string(job.cpus) + " " + job.sbatch + " --wrap true",
                             stop);
  const bool later = run.failed.find("busy") != std::string::npos; // it would wait
  if (!run.failed.empty() && !later) throw Error("sbatch: " + run.failed);
}

void requireRoom(const ClusterJob& job) {
  if (fs::exists(job.folder))
    throw Error(job.folder.string() + ": exists; expected a new folder (palp cluster status " + job.folder.string() +
                " shows the progress of the job in it)");
  if (job.kind == "study") {
    StudyFolder::requireFits(job.output, loadStudy(job.workFolder / job.arguments.at(0)));
    return;
  }
  const fs::path folder = job.output.parent_path();
  if (!fs::is_directory(folder)) throw Error("-o: folder '" + folder.string() + "' does not exist");
  requireWritable(job.output, std::find(job.arguments.begin(), job.arguments.end(), "--force") != job.arguments.end());
}

void writeJob(const ClusterJob& job) {
  requireRoom(job);
  std::error_code failed;
  for (const char* part : {"shards", "done", "failed", "logs"}) {
    fs::create_directories(job.folder / part, failed);
    if (failed) throw Error((job.folder / part).string() + ": the folder cannot be created: " + failed.message());
  }
  for (const auto& [name, content] : clusterScripts(job)) {
    writeFile(job.folder / name, content, true);
    fs::permissions(job.folder / name, fs::perms::owner_exec | fs::perms::group_exec, fs::perm_options::add);
  }
  const auto json = [&job](auto&& named) {
    std::vector<std::string> arguments;
    for (const std::string& argument : job.arguments) arguments.push_back(named(argument));
    return Json{{"palp_cluster", 1},
                {"kind", job.kind},
                {"arguments", arguments},
                {"output", named(job.output.string())},
                {"shards", job.shards},
                {"cpus", job.cpus},
                {"work_folder", named(job.workFolder.string())},
                {"program", named(job.program.string())},
                {"seconds_a_shard", job.secondsAShard},
                {"memory_MB", job.memory_MB},
                {"sbatch", named(job.sbatch)}};
  };
  std::optional<std::string> text = asUtf8(json([](const std::string& name) { return name; }));
  if (!text) {
    Json latin = json(fromLatin1);
    latin["letters"] = kLatin1;
    text = jsonText(latin, 1);
  }
  writeFile(job.folder / "job.json", *text + "\n", true);
}

ClusterJob readJob(const fs::path& folder) {
  const fs::path file = folder / "job.json";
  if (!fs::exists(file))
    throw Error(folder.string() + ": contains no job.json; expected a folder written by palp cluster sample or study");
  const Json json = parseJson(readFile(file), file.string());
  const JsonPlace root(json, file.string());
  formatVersion(root, "palp_cluster", 1);
  root.onlyKeys({"palp_cluster", "kind", "arguments", "output", "shards", "cpus", "work_folder", "program",
                 "seconds_a_shard", "memory_MB"},
                {"sbatch", "letters"});
  const bool latin = root.has("letters");
  if (latin && root.at("letters").string() != kLatin1) root.at("letters").refuse(kLatin1);
  const auto name = [latin](const JsonPlace& place) { return latin ? toLatin1(place.string()) : place.string(); };
  ClusterJob job;
  job.kind = root.at("kind").string();
  if (job.kind != "sample" && job.kind != "study") root.at("kind").refuse("sample or study");
  for (const JsonPlace& argument : root.at("arguments").list()) job.arguments.push_back(name(argument));
  job.output = name(root.at("output"));
  job.shards = root.at("shards").integer(1, 100'000);
  job.cpus = root.at("cpus").integer(1, 4096);
  job.workFolder = name(root.at("work_folder"));
  job.program = name(root.at("program"));
  job.secondsAShard = root.at("seconds_a_shard").number();
  job.memory_MB = root.at("memory_MB").number();
  if (root.has("sbatch")) job.sbatch = name(root.at("sbatch"));
  job.folder = fs::absolute(folder).lexically_normal();
  return job;
}

namespace {

/// What Slurm's queue has of the job: the tasks of its arrays, and its merges.
void askQueue(const ClusterJob& job, ClusterStatus& status, const std::stop_token& stop) {
  const fs::path known = job.folder / kSlurmNumbers;
  if (!fs::exists(known)) return;
  std::string ids;
  std::set<std::string> merges;
  for (const std::string& line : linesOf(readFile(known))) {
    const bool merge = line.starts_with(kMergeMark);
    const std::string id = merge ? line.substr(std::string(kMergeMark).size()) : line;
    if (id.empty() || !std::all_of(id.begin(), id.end(), [](char c) { return c >= '0' && c <= '9'; }))
      throw Error(known.string() + ": " + gotExpected(quotedText(line), "the number of a Slurm job"));
    if (merge) merges.insert(id);
    ids += (ids.empty() ? "" : ",") + id;
  }
  const ChildRun run = slurm(job, "squeue --noheader --array --jobs=" + ids + " --format='%F %K %t'", stop);
  // It refuses a number that it has long forgotten, and then there is nothing of it.
  if (!run.failed.empty() && run.failed.find("Invalid job id") == std::string::npos) {
    status.queueFailed = "the queue cannot be read: squeue: " + run.failed;
    std::fill(status.shards.begin(), status.shards.end(), ShardState::Unknown);
    return;
  }
  for (const std::string& line : linesOf(run.output)) {
    std::istringstream words(line);
    std::string id, number, state;
    if (!(words >> id >> number >> state)) continue;
    const bool waits = state == "PD" || state == "RQ" || state == "RH";
    if (merges.contains(id)) {
      if (waits) status.waitingMerges.push_back(id);
      status.merging = status.merging || !waits;
      continue;
    }
    const int shard = std::atoi(number.c_str());
    if (shard < 1 || shard > job.shards) continue;
    status.shards[static_cast<std::size_t>(shard - 1)] = waits ? ShardState::Waiting : ShardState::Running;
    if (std::find(status.arrays.begin(), status.arrays.end(), id) == status.arrays.end()) status.arrays.push_back(id);
  }
}

} // namespace

ClusterStatus statusOf(const ClusterJob& job, const std::stop_token& stop) {
  ClusterStatus status;
  status.shards.assign(static_cast<std::size_t>(job.shards), ShardState::Missing);
  status.merged = fs::exists(job.folder / "done" / "merge");
  if (!status.merged) askQueue(job, status, stop);
  for (int n = 1; n <= job.shards; ++n) {
    ShardState& state = status.shards[static_cast<std::size_t>(n - 1)];
    if (fs::exists(doneMark(job, n)))
      state = ShardState::Done;
    else if (const fs::path failed = job.folder / "failed" / std::to_string(n);
             (state == ShardState::Missing || state == ShardState::Unknown) && fs::exists(failed)) {
      state = ShardState::Failed;
      std::string code = readFile(failed);
      code.erase(std::remove(code.begin(), code.end(), '\n'), code.end());
      status.failures.push_back("shard " + std::to_string(n) + " ended with status " + code + ": " +
                                (job.folder / "logs" / (std::to_string(n) + ".txt")).string());
    }
  }
  return status;
}

std::string submit(const ClusterJob& job, const std::vector<int>& shards, const ClusterStatus& queue,
                   const std::stop_token& stop) {
  requireSbatch(job);
  const fs::path known = job.folder / kSlurmNumbers;
  const auto hand = [&](const std::string& what, const char* mark) {
    const ChildRun run = slurm(job, "sbatch --parsable " + what, stop);
    if (!run.failed.empty()) throw Error("sbatch: " + run.failed);
    const std::string id = run.output.substr(0, run.output.find_first_of(";\n"));
    writeFile(known, (fs::exists(known) ? readFile(known) : "") + mark + id + "\n", true);
    return id;
  };
  std::string array, after;
  if (!shards.empty()) {
    array = hand("--array=" + asRanges(shards) + " " + shellWord((job.folder / "array.sbatch").string()), "");
    after = "afterok:" + array;
  }
  for (const std::string& id : queue.arrays) after += (after.empty() ? "" : ",") + ("afterany:" + id);
  // The merge that waits for what failed would wait for ever.
  for (const std::string& id : queue.waitingMerges) slurm(job, "scancel " + id, stop);
  hand((after.empty() ? "" : "--kill-on-invalid-dep=yes --dependency=" + after + " ") +
           shellWord((job.folder / "merge.sbatch").string()),
       kMergeMark);
  return array;
}

} // namespace palp
