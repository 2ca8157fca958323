#pragma once

#include <filesystem>
#include <map>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// `palp sample` or `palp study` in shards, for Slurm's job arrays (https://slurm.schedmd.com/job_array.html) or GNU
/// parallel: a folder of scripts, which need nothing but a shell and palp.
struct ClusterJob {
  std::string kind;                   ///< "sample" or "study"
  std::vector<std::string> arguments; ///< of the command, but for its output and shard
  std::filesystem::path output;       ///< sample file, or the study's folder
  int shards = 1;
  int cpus = 1;                     ///< of a shard
  std::filesystem::path folder;     ///< of the scripts, shards and messages
  std::filesystem::path workFolder; ///< where relative paths begin
  std::filesystem::path program;    ///< palp
  double secondsAShard = 0;         ///< expected, from what was measured
  double memory_MB = 0;             ///< most that was measured
  std::string sbatch;               ///< more options of sbatch, as typed: "--partition=short --account=lab"
};

/// Asks Slurm whether it would take such an array: its limit of tasks (scontrol), account, partition and the other
/// options (sbatch --test-only). Before anything is measured or written. Throws Error with Slurm's words.
void requireAccepted(const ClusterJob& job, const std::stop_token& stop);

/// What one shard costs, by running the first samples (or the first design) in a process of its own: sets
/// secondsAShard and memory_MB. Throws Error where the command is refused, with its own words, and Cancelled.
void measure(ClusterJob& job, const std::stop_token& stop);

/// The scripts by name: shard.sh (does one shard, nothing where it is done), merge.sh, array.sbatch, merge.sbatch (once
/// all shards are done), here.sh (all of it on this machine by GNU parallel).
std::map<std::string, std::string> clusterScripts(const ClusterJob& job);

/// Throws Error where the job's folder is there already, or its output could not be written at last.
void requireRoom(const ClusterJob& job);
/// Writes scripts and job.json. Throws Error.
void writeJob(const ClusterJob& job);
/// The job of a folder. Throws Error.
ClusterJob readJob(const std::filesystem::path& folder);

/// State of a shard. Running and Waiting come from Slurm's squeue. Unknown: it does not answer, and the shard may
/// be in the queue.
enum class ShardState { Unknown, Missing, Waiting, Running, Failed, Done };
struct ClusterStatus {
  std::vector<ShardState> shards;
  std::string queueFailed;           ///< why squeue does not answer; empty where it does, or nothing was submitted
  std::vector<std::string> failures; ///< sentences: which shard, with what status
  bool merged = false;
  std::vector<std::string> arrays;        ///< numbers of the job arrays that Slurm's queue has
  std::vector<std::string> waitingMerges; ///< of the joining jobs that wait in it
  bool merging = false;                   ///< one of them runs
};
ClusterStatus statusOf(const ClusterJob& job, const std::stop_token& stop);

/// Hands the shards (counted from 1) to Slurm, and a merge after them and after what its queue still has, in place of
/// merges that wait; gives the array's number. Throws Error with sbatch's own words.
std::string submit(const ClusterJob& job, const std::vector<int>& shards, const ClusterStatus& queue,
                   const std::stop_token& stop);

} // namespace palp
