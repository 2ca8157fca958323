// palp study and palp cluster without a cluster: what they write is run by the shell, Slurm's commands by stand-ins.

#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cstdlib>

using nlohmann::json;
using namespace palp::test;

namespace {

namespace fs = std::filesystem;

const std::string kStudy =
    R"({"palp_study": 1, "design": "paper", "mapped": [4, 4, 2], "per_area": 8, "decoders": ["linear"],
  "compute": ["bound", "decoders", "displacement", "error"],
  "vary": [{"key": "upper_layer.z_mm", "values": [3.5, 9, 4]}, {"key": "block_mm.2", "from": 4.6, "to": 6, "count": 2}]})";

Outcome runShell(const fs::path& folder, const std::string& line) {
  const fs::path log = folder / "shell.txt";
  const int status = std::system(("( " + line + " ) > '" + log.string() + "' 2>&1").c_str()); // NOLINT(cert-env33-c)
  return {status, readAll(log), {}};
}

/// A program of that name that is found before others: of this process alone.
void standIn(const palp::TemporaryFolder& folder, const std::string& name, const std::string& script) {
  fs::create_directory(folder / "bin");
  writeAll(folder / "bin" / name, "#!/bin/sh\n" + script);
  fs::permissions(folder / "bin" / name, fs::perms::owner_all);
  const std::string path = (folder / "bin").string() + ":" + std::getenv("PATH"); // NOLINT(concurrency-mt-unsafe)
  ::setenv("PATH", path.c_str(), 1);                                              // NOLINT(concurrency-mt-unsafe)
}

} // namespace

TEST(StudyCommand, GoesOnInAFolderThatAnotherShardHasJustBegunAndRefusesABrokenRow) {
  const palp::TemporaryFolder folder;
  const std::string all = R"(["bound", "decoders", "displacement", "error"])";
  std::string study = kStudy;
  study.replace(study.find(all), all.size(), R"(["displacement"])");
  writeAll(folder / "study.json", study);
  fs::create_directories(folder / "out" / "rows");
  writeAll(folder / "out" / ".study.new77.json", "half");
  const std::vector<std::string> words{"study", folder / "study.json", "-o", folder / "out"};
  const Outcome outcome = palp::test::palp(words);
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  for (const char* broken : {"2,4,4.6,\n", "2\n", "", "3,3.5,5.3,,1\n", "2,4,4.6,,1"}) {
    writeAll(folder / "out" / "rows" / "0000002.csv", broken);
    const Outcome refused = palp::test::palp(words);
    EXPECT_EQ(refused.exit, 2) << broken;
    EXPECT_NE(refused.errors.find("0000002.csv: no row of design 2"), std::string::npos) << refused.errors;
  }
}

TEST(StudyCommand, MakesOneRowADesignAndSaysWhichCannotBe) {
  const palp::TemporaryFolder folder;
  writeAll(folder / "study.json", kStudy);
  const Outcome outcome = palp::test::palp({"study", folder / "study.json", "-o", folder / "out", "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  EXPECT_EQ(outcome.json().at("designs"), 6);
  EXPECT_EQ(outcome.json().at("done"), 6);
  const std::string table = readAll(folder / "out" / "table.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 7) << table;
  EXPECT_TRUE(table.starts_with("design,upper_layer.z_mm,block_mm.2,problem,bound_fx_percent,")) << table;
  EXPECT_NE(table.find("\n1,9,4.6,\"upper_layer.z_mm: "), std::string::npos) << "wires above the block: " << table;
  EXPECT_NE(table.find("\n2,4,4.6,,"), std::string::npos) << table;
  EXPECT_NE(readAll(folder / "out" / "report" / "report.html").find("Designs without a result"), std::string::npos);
}

TEST(StudyCommand, GivesTheSameBytesInShardsAfterAStopAndWithOneThread) {
  const palp::TemporaryFolder folder;
  writeAll(folder / "study.json", kStudy);
  const auto study = [&](const char* out, const std::vector<std::string>& more) {
    std::vector<std::string> words{"study", folder / "study.json", "-o", folder / out, "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  ASSERT_EQ(palp::test::palp(study("whole", {"--threads", "1"})).exit, 0);
  const Outcome stopped = palpInterruptedAt(study("parts", {}), 0.4);
  EXPECT_EQ(stopped.exit, 130) << stopped.errors;
  EXPECT_FALSE(fs::exists(folder / "parts" / "table.csv"));
  EXPECT_LT(stopped.json().at("done"), 6);
  ASSERT_EQ(palp::test::palp(study("parts", {"--shard", "2/2"})).exit, 0);
  EXPECT_FALSE(fs::exists(folder / "parts" / "table.csv")) << "a shard joins nothing";
  ASSERT_EQ(palp::test::palp(study("parts", {})).exit, 0);
  EXPECT_EQ(readAll(folder / "whole" / "table.csv"), readAll(folder / "parts" / "table.csv"));
}

TEST(StudyCommand, RefusesTheFolderOfAnotherStudy) {
  const palp::TemporaryFolder folder;
  writeAll(folder / "study.json", kStudy);
  ASSERT_EQ(palp::test::palp({"study", folder / "study.json", "-o", folder / "out", "--shard", "1/6"}).exit, 0);
  std::string other = kStudy;
  other.replace(other.find("4.6"), 3, "4.7");
  writeAll(folder / "other.json", other);
  const Outcome refused = palp::test::palp({"study", folder / "other.json", "-o", folder / "out"});
  EXPECT_EQ(refused.exit, 2);
  EXPECT_NE(refused.errors.find("another study"), std::string::npos) << refused.errors;
  fs::create_directory(folder / "foreign");
  writeAll(folder / "foreign" / "notes.txt", "mine");
  const Outcome foreign = palp::test::palp({"study", folder / "study.json", "-o", folder / "foreign"});
  EXPECT_EQ(foreign.exit, 2);
  EXPECT_NE(foreign.errors.find("contains no study"), std::string::npos) << foreign.errors;
}

TEST(ClusterCommand, ItsScriptsMakeTheBytesOfOneRun) {
  const palp::TemporaryFolder folder;
  const std::vector<std::string> own{"paper", "--per-area", "12", "--mapped", "4x4x2", "--seed", "3"};
  std::vector<std::string> one{"sample"};
  one.insert(one.end(), own.begin(), own.end());
  one.insert(one.end(), {"-o", folder / "one.csv"});
  ASSERT_EQ(palp::test::palp(one).exit, 0);
  std::vector<std::string> words{"cluster", "sample"};
  words.insert(words.end(), own.begin(), own.end());
  words.insert(words.end(), {"-o", folder / "it's merged.csv", "--shards", "3", "--folder", folder / "job", "--json"});
  const Outcome made = palp::test::palp(words);
  ASSERT_EQ(made.exit, 0) << made.errors;
  EXPECT_GT(made.json().at("seconds_a_shard"), 0);
  EXPECT_GT(made.json().at("memory_MB"), 10);
  const std::string array = readAll(folder / "job" / "array.sbatch");
  for (const char* line : {"#SBATCH --array=1-3\n", "#SBATCH --requeue\n", "#SBATCH --mem=", "#SBATCH --time=0:0"})
    EXPECT_NE(array.find(line), std::string::npos) << array;

  const std::string job = (folder / "job").string();
  for (const char* shard : {"3", "1"}) ASSERT_EQ(runShell(folder.path(), "'" + job + "/shard.sh' " + shard).exit, 0);
  Outcome status = palp::test::palp({"cluster", "status", job, "--json"});
  EXPECT_EQ(status.json().at("done"), 2) << status.output;
  EXPECT_EQ(status.json().at("missing"), 1);
  EXPECT_NE(runShell(folder.path(), "'" + job + "/merge.sh'").exit, 0) << "a shard is missing";
  EXPECT_FALSE(fs::exists(folder / "it's merged.csv"));
  ASSERT_EQ(runShell(folder.path(), "'" + job + "/shard.sh' 2").exit, 0);
  const Outcome again = runShell(folder.path(), "'" + job + "/shard.sh' 2");
  EXPECT_EQ(again.exit, 0);
  EXPECT_EQ(again.output, "") << "what is done is not done again";
  ASSERT_EQ(runShell(folder.path(), "'" + job + "/merge.sh'").exit, 0) << readAll(folder / "shell.txt");
  status = palp::test::palp({"cluster", "status", job, "--json"});
  EXPECT_EQ(status.json().at("merged"), true);
  EXPECT_EQ(readAll(folder / "one.csv"), readAll(folder / "it's merged.csv"));
  EXPECT_EQ(palp::test::palp(words).exit, 2) << "its folder is there";
}

TEST(ClusterCommand, MakesAStudyInShards) {
  const palp::TemporaryFolder folder;
  writeAll(folder / "study.json", kStudy);
  ASSERT_EQ(palp::test::palp({"study", folder / "study.json", "-o", folder / "whole"}).exit, 0);
  const Outcome made = palp::test::palp(
      {"cluster", "study", folder / "study.json", "-o", folder / "parts", "--shards", "2", "--folder", folder / "job"});
  ASSERT_EQ(made.exit, 0) << made.errors;
  const std::string job = (folder / "job").string();
  const Outcome all =
      runShell(folder.path(), "'" + job + "/shard.sh' 2 && '" + job + "/shard.sh' 1 && '" + job + "/merge.sh'");
  ASSERT_EQ(all.exit, 0) << all.output;
  EXPECT_EQ(readAll(folder / "whole" / "table.csv"), readAll(folder / "parts" / "table.csv"));
}

/// Stand-ins for Slurm's commands: what is handed in is kept, what runs is told.
TEST(ClusterCommand, HandsInAndSubmitsAgainOnlyWhatIsMissing) {
  const palp::TemporaryFolder folder;
  const std::string asked_txt = "'" + (folder / "asked.txt").string() + "'";
  standIn(folder, "sbatch", "echo \"$@\" >> " + asked_txt + "\necho $((40 + $(grep -c sbatch " + asked_txt + ")))\n");
  standIn(folder, "squeue", "echo '41 3 R'\necho '41 4 PD'\necho '42 N/A PD'\n");
  standIn(folder, "scancel", "echo scancel \"$@\" >> " + asked_txt + "\n");
  const std::string job = (folder / "job").string();
  const Outcome made = palp::test::palp({"cluster", "sample", "paper", "--per-area", "5", "--mapped", "4x4x2", "-o",
                                         folder / "s.csv", "--shards", "5", "--folder", job, "--submit", "--json"});
  ASSERT_EQ(made.exit, 0) << made.errors;
  EXPECT_EQ(made.json().at("job"), "41");
  const std::string asked = readAll(folder / "asked.txt");
  EXPECT_NE(asked.find("--array=1-5 " + job + "/array.sbatch"), std::string::npos) << asked;
  EXPECT_NE(asked.find("--kill-on-invalid-dep=yes --dependency=afterok:41 " + job + "/merge.sbatch"), std::string::npos)
      << asked;

  ASSERT_EQ(runShell(folder.path(), "'" + job + "/shard.sh' 1").exit, 0);
  writeAll(folder / "job" / "failed" / "5", "137\n");
  const Outcome status = palp::test::palp({"cluster", "status", job, "--json", "--resubmit"});
  ASSERT_EQ(status.exit, 0) << status.errors;
  for (const auto& [state, count] :
       {std::pair{"done", 1}, {"running", 1}, {"waiting", 1}, {"failed", 1}, {"missing", 1}})
    EXPECT_EQ(status.json().at(state), count) << state;
  EXPECT_EQ(status.json().at("submitted"), (json{2, 5}));
  std::string now = readAll(folder / "asked.txt").substr(asked.size());
  EXPECT_NE(now.find("--array=2,5 "), std::string::npos);
  EXPECT_NE(now.find("scancel 42\n"), std::string::npos) << "the merge of before waits for what has failed: " << now;
  EXPECT_NE(now.find("--dependency=afterok:43,afterany:41 "), std::string::npos) << now;

  // All that is left is at work: the merge waits for it, and no shard is handed in twice.
  for (const char* shard : {"2", "5"}) writeAll(folder / "job" / "done" / shard, "");
  const std::string before = readAll(folder / "asked.txt");
  ASSERT_EQ(palp::test::palp({"cluster", "status", job, "--resubmit"}).exit, 0);
  now = readAll(folder / "asked.txt").substr(before.size());
  EXPECT_EQ(now.find("--array"), std::string::npos) << now;
  EXPECT_NE(now.find("--dependency=afterany:41 "), std::string::npos) << now;
  writeAll(folder / "job" / "slurm.txt", "41\nnone; rm -rf\n");
  const Outcome broken = palp::test::palp({"cluster", "status", job});
  EXPECT_EQ(broken.exit, 2);
  EXPECT_NE(broken.errors.find("none; rm -rf"), std::string::npos) << broken.errors;
}

TEST(ClusterCommand, SubmitsNothingWhileTheQueueDoesNotAnswer) {
  const palp::TemporaryFolder folder;
  const std::string asked_txt = "'" + (folder / "asked.txt").string() + "'";
  standIn(folder, "sbatch", "echo sbatch >> " + asked_txt + "\necho 77\n");
  standIn(folder, "squeue", "echo 'slurm_load_jobs error: Unable to contact slurm controller' >&2\nexit 1\n");
  const std::string job = (folder / "job").string();
  ASSERT_EQ(palp::test::palp({"cluster", "sample", "paper", "--per-area", "1", "--mapped", "4x4x2", "-o",
                              folder / "s.csv", "--shards", "3", "--folder", job})
                .exit,
            0);
  writeAll(folder / "job" / "slurm.txt", "41\nmerge 42\n");
  writeAll(folder / "job" / "done" / "2", "");
  const Outcome down = palp::test::palp({"cluster", "status", job, "--resubmit", "--json"});
  EXPECT_EQ(down.exit, 1);
  EXPECT_NE(down.errors.find("the queue cannot be read: squeue: status 1: slurm_load_jobs error: Unable"),
            std::string::npos)
      << down.errors;
  for (const auto& [state, count] : {std::pair{"done", 1}, {"unknown", 2}, {"missing", 0}})
    EXPECT_EQ(down.json().at(state), count) << state;
  EXPECT_FALSE(fs::exists(folder / "asked.txt")) << "submitted again";

  standIn(folder, "squeue", "echo 'slurm_load_jobs error: Invalid job id specified' >&2\nexit 1\n");
  const Outcome gone = palp::test::palp({"cluster", "status", job, "--json"});
  EXPECT_EQ(gone.exit, 0) << gone.errors;
  EXPECT_EQ(gone.json().at("missing"), 2) << "Slurm has forgotten the number";
}

TEST(ClusterCommand, AsksSlurmForItsLimitsBeforeTheWork) {
  const palp::TemporaryFolder folder;
  standIn(folder, "sbatch",
          "case \"$*\" in *--account=lab*) echo 'sbatch: error: Invalid account' >&2; exit 1;; esac\n");
  standIn(folder, "scontrol", "echo 'MaxArraySize            = 4'\n");
  const auto refused = [&](const std::vector<std::string>& more, const std::string& says) {
    std::vector<std::string> words{"cluster", "sample",         "paper",    "--per-area",  "1",
                                   "-o",      folder / "s.csv", "--folder", folder / "job"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = palp::test::palp(words);
    EXPECT_EQ(outcome.exit, 2) << outcome.errors;
    EXPECT_NE(outcome.errors.find(says), std::string::npos) << outcome.errors;
    EXPECT_EQ(outcome.errors.find("measuring"), std::string::npos) << outcome.errors;
  };
  refused({"--shards", "4", "--submit"}, "--shards: got 4, expected at most 3 on this cluster");
  refused({"--shards", "3", "--submit", "--sbatch", "--account=lab"}, "Invalid account");
  refused({"--shards", "3", "--sbatch", "short"}, "--sbatch: got 'short'");
  refused({"--shards", "3", "--sbatch", "-p x; rm"}, "--sbatch: got '-p x; rm'");
  refused({"--shards", "3", "--sbatch", "--array=1"}, "--sbatch: got --array");
  EXPECT_FALSE(fs::exists(folder / "job"));
}

TEST(ClusterCommand, KeepsOptionsOfSlurmAndNamesThatAreNotUtf8) {
  const palp::TemporaryFolder folder;
  const fs::path job = folder / "job \xe9\xff";
  const Outcome made = palp::test::palp({"cluster", "sample", "paper", "--per-area", "1", "--mapped", "4x4x2", "-o",
                                         folder / "s\xfc.csv", "--shards", "1", "--folder", job, "--sbatch",
                                         "--partition=short --account=lab", "--json"});
  ASSERT_EQ(made.exit, 0) << made.errors;
  for (const char* script : {"array.sbatch", "merge.sbatch"})
    EXPECT_NE(readAll(job / script).find("\n#SBATCH --partition=short --account=lab\n"), std::string::npos) << script;
  ASSERT_EQ(runShell(folder.path(), "cd '" + job.string() + "' && ./shard.sh 1 && ./merge.sh").exit, 0);
  const Outcome status = palp::test::palp({"cluster", "status", job});
  EXPECT_EQ(status.exit, 0) << status.errors;
  EXPECT_NE(status.output.find("merged into " + (folder / "s\xfc.csv").string()), std::string::npos) << status.output;
}

/// Of GNU parallel: each line of its input is appended to the command, which a shell runs.
TEST(ClusterCommand, RunsOnOneMachineInFoldersOfAnyName) {
  const palp::TemporaryFolder folder;
  standIn(folder, "parallel", "[ \"$1\" = --jobs ] || exit 9\nwhile read n; do sh -c \"$3 $n\" || exit 1; done\n");
  const fs::path job = folder / "50 % of it's \"job\"";
  ASSERT_EQ(palp::test::palp({"cluster", "sample", "paper", "--per-area", "2", "--mapped", "4x4x2",
                              "--output=" + (folder / "all of it").string(), "--shards", "2", "--folder", job})
                .exit,
            0);
  EXPECT_NE(readAll(job / "array.sbatch").find("/50 %% of it's \\\"job\\\"/logs/%a.txt\""), std::string::npos)
      << readAll(job / "array.sbatch");
  const Outcome outcome = runShell(folder.path(), "cd '" + folder.path().string() + "'/50* && ./here.sh 2");
  ASSERT_EQ(outcome.exit, 0) << outcome.output;
  EXPECT_EQ(palp::test::palp({"cluster", "status", job, "--json"}).json().at("merged"), true);
  EXPECT_TRUE(fs::exists(folder / "all of it"));
}

TEST(ClusterCommand, ADryRunShowsTheScriptsAndWritesNothing) {
  const palp::TemporaryFolder folder;
  const Outcome shown = palp::test::palp({"cluster", "sample", "paper", "--per-area", "5", "--mapped", "4x4x2", "-o",
                                          folder / "s.csv", "--shards", "2", "--folder", folder / "job", "--dry-run"});
  ASSERT_EQ(shown.exit, 0) << shown.errors;
  EXPECT_NE(shown.output.find("#SBATCH --array=1-2"), std::string::npos) << shown.output;
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ClusterCommand, RefusesInOneLine) {
  const palp::TemporaryFolder folder;
  const auto refused = [](const std::vector<std::string>& words, const std::string& says) {
    std::vector<std::string> all{"cluster"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = palp::test::palp(all);
    EXPECT_EQ(outcome.exit, 2) << says;
    EXPECT_NE(outcome.errors.find(says), std::string::npos) << outcome.errors;
  };
  const std::string out = folder / "s.csv", job = folder / "job";
  refused({"fly", "paper"}, "fly");
  refused({"sample", "paper", "--per-area", "5", "-o", out}, "--shards is missing");
  refused({"sample", "paper", "--per-area", "5", "--shards", "2"}, "-o is missing");
  refused({"sample", "-o", out, "--shards", "2", "--folder", job}, "design is missing");
  refused({"sample", "paper", "--per-area", "5", "-o", out, "--shards", "0"}, "--shards");
  refused({"sample", "paper", "--per-area", "5", "--shard", "1/2", "-o", out, "--shards", "2"}, "--shard");
  refused({"sample", "nowhere.json", "--per-area", "5", "-o", out, "--shards", "2", "--folder", job}, "nowhere.json");
  refused({"sample", "paper", "--perarea", "5", "-o", out, "--shards", "2", "--folder", job}, "perarea");
  refused({"sample", "paper", "--per-area", "5", "-o", folder / "no" / "s.csv", "--shards", "2"}, "does not exist");
  refused({"sample", "paper", "--per-area", "5", "-o", folder.path(), "--shards", "2"}, "is a folder");
  refused({"status", folder.path()}, "job.json");
  refused({"status"}, "got 0 folders");
  EXPECT_TRUE(fs::is_empty(folder.path()));
  writeAll(out, "precious");
  refused({"sample", "paper", "--per-area", "5", "-o", out, "--shards", "2", "--folder", job}, "--force");
}
