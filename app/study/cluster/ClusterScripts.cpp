#include "app/study/cluster/ShellWords.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace palp {

namespace {

constexpr double kTimeMargin = 2; // of the limit over what is expected: nodes differ
constexpr double kSpareTime_s = 300, kMergeTime_s = 3600;
constexpr double kMemoryMargin = 1.3, kSpareMemory_MB = 200;
constexpr long kMergeMemory_MB = 1000;

std::string asTime(double seconds) {
  const auto minutes = static_cast<long>(std::ceil((kTimeMargin * seconds + kSpareTime_s) / 60));
  std::string rest = std::to_string(minutes % 60);
  if (rest.size() < 2) rest.insert(0, "0");
  return std::to_string(minutes / 60) + ":" + rest + ":00";
}

/// A file of messages in a line of #SBATCH: in quotes, and % doubled, which means a number there.
std::string logFile(const std::filesystem::path& folder, const std::string& pattern) {
  std::string result = "\"";
  for (const char c : folder.string() + "/") {
    if (c == '"' || c == '\\') result += '\\';
    result += c == '%' ? "%%" : std::string(1, c);
  }
  return result + pattern + "\"";
}

std::string sbatchHead(const ClusterJob& job, const std::string& name, const std::string& resources,
                       const std::string& log) {
  return "#!/bin/sh\n#SBATCH --job-name=palp-" + name + "\n" + resources +
         "#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --output=" + logFile(job.folder / "logs", log) + "\n" +
         (job.sbatch.empty() ? "" : "#SBATCH " + job.sbatch + "\n");
}

std::string resources(const ClusterJob& job, long memory_MB, double seconds) {
  return "#SBATCH --cpus-per-task=" + std::to_string(job.cpus) + "\n#SBATCH --mem=" + std::to_string(memory_MB) +
         "M\n#SBATCH --time=" + asTime(seconds) + "\n";
}

std::string shardScript(const ClusterJob& job) {
  const std::string folder = shellWord(job.folder.string()), all = std::to_string(job.shards);
  const bool study = job.kind == "study";
  const std::string part =
      study ? shellWord(job.output.string()) : shellWord((job.folder / "shards").string()) + "/$n" + extensionOf(job);
  return "#!/bin/sh\n"
         "# One shard of " +
         all +
         ", number $1: nothing to do if it is complete; an interrupted one continues.\n"
         "n=$1\n"
         "cd " +
         shellWord(job.workFolder.string()) +
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
}

/// The names of the shards are short, as all of them are in one command.
std::string mergeScript(const ClusterJob& job) {
  const bool study = job.kind == "study";
  const std::string command = study ? commandOf(job) + " -o " + shellWord(job.output.string())
                                    : shellWord(job.program.string()) + " merge $(seq -f %.0f" + extensionOf(job) +
                                          " " + std::to_string(job.shards) + ") -o " + shellWord(job.output.string()) +
                                          " --force";
  return "#!/bin/sh\n"
         "# All shards into one.\n"
         "cd " +
         shellWord((study ? job.workFolder : job.folder / "shards").string()) + " || exit 1\n" + command +
         "\nstatus=$?\n[ $status -eq 0 ] && touch " + shellWord(job.folder.string()) + "/done/merge\nexit $status\n";
}

} // namespace

std::string shellWord(const std::string& word) {
  const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("-_./,:=@+").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (plain) return word;
  std::string result = "'";
  for (const char c : word) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string commandOf(const ClusterJob& job) {
  std::string words = shellWord(job.program.string()) + " " + job.kind;
  for (const std::string& argument : job.arguments) words += " " + shellWord(argument);
  return words;
}

std::string extensionOf(const ClusterJob& job) {
  if (job.kind == "study") return "";
  const std::string extension = job.output.extension().string();
  const bool plain =
      std::all_of(extension.begin(), extension.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '.'; });
  return plain ? extension : ""; // what it is not known by, is CSV
}

std::string asRanges(const std::vector<int>& numbers) {
  std::string all;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    all += (all.empty() ? "" : ",") + std::to_string(numbers[i]);
    if (end - i > 1) all += "-" + std::to_string(numbers[end - 1]);
    i = end;
  }
  return all;
}

std::map<std::string, std::string> clusterScripts(const ClusterJob& job) {
  const std::string folder = shellWord(job.folder.string()), all = std::to_string(job.shards);
  const long memory = static_cast<long>(std::ceil(kMemoryMargin * job.memory_MB + kSpareMemory_MB));
  std::map<std::string, std::string> scripts;
  scripts["shard.sh"] = shardScript(job);
  scripts["merge.sh"] = mergeScript(job);
  scripts["array.sbatch"] =
      sbatchHead(job, job.kind, "#SBATCH --array=1-" + all + "\n" + resources(job, memory, job.secondsAShard),
                 "%a.txt") +
      "# Measured: " + text(std::round(10 * job.secondsAShard) / 10) + " s a shard, " +
      text(std::round(job.memory_MB)) + " MB; the limits leave room for slower nodes.\n" + folder +
      "/shard.sh \"$SLURM_ARRAY_TASK_ID\"\n"
      "status=$?\n"
      "# Killed (memory, a node in trouble): again, three times at most, and on from what was made.\n"
      "[ $status -gt 128 ] && [ \"${SLURM_RESTART_COUNT:-0}\" -lt 3 ] && scontrol requeue \"$SLURM_JOB_ID\"\n"
      "exit $status\n";
  scripts["merge.sbatch"] =
      sbatchHead(job, "merge", resources(job, std::max(kMergeMemory_MB, memory), kMergeTime_s), "merge.txt") + "exec " +
      folder + "/merge.sh\n";
  scripts["here.sh"] = // GNU parallel hands its words to a shell of its own
      "#!/bin/sh\n"
      "# All shards on this machine by GNU parallel, $1 at a time (default 1), then the merge.\n"
      "seq " +
      all + " | parallel --jobs \"${1:-1}\" " + shellWord(folder + "/shard.sh") + " && exec " + folder + "/merge.sh\n";
  return scripts;
}

} // namespace palp
