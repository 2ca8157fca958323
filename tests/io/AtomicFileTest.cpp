#include "io/AtomicFile.h"

#include "io/FilesTogether.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <iterator>

namespace palp {
namespace {

namespace fs = std::filesystem;

auto filesIn(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), {});
}

/// What a process leaves that is killed while it writes.
void killWhileWriting(const fs::path& file) {
  const pid_t child = ::fork();
  if (child == 0) {
    const AtomicFile writing(file, true);
    put(writing.temporary(), "half");
    ::raise(SIGKILL);
  }
  ::waitpid(child, nullptr, 0);
}

TEST(AtomicFile, WritesTheWholeFileAndLeavesNothingBeside) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "first", false);
  EXPECT_EQ(readFile(folder / "a.txt"), "first");
  EXPECT_EQ(filesIn(folder.path()), 1);
}

TEST(AtomicFile, RefusesToOverwriteUnlessForced) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "first", false);
  const std::string sentence = refusal([&] { writeFile(folder / "a.txt", "second", false); });
  EXPECT_NE(sentence.find("a.txt"), std::string::npos);
  EXPECT_NE(sentence.find("--force"), std::string::npos);
  EXPECT_EQ(readFile(folder / "a.txt"), "first");
  writeFile(folder / "a.txt", "second", true);
  EXPECT_EQ(readFile(folder / "a.txt"), "second");
}

TEST(AtomicFile, DropsWhatWasNeverCommitted) {
  const TemporaryFolder folder;
  {
    const AtomicFile file(folder / "picture.png", false);
    EXPECT_EQ(file.temporary().extension(), ".png");
    put(file.temporary(), "half");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(AtomicFile, NamesTheFolderThatIsMissing) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal([&] { writeFile(folder / "no" / "a.txt", "x", false); }).find("No such file"), std::string::npos);
  EXPECT_NE(refusal([&] { writeFile(folder.path(), "x", true); }).find("is a folder"), std::string::npos);
  EXPECT_NE(refusal([&] { readFile(folder / "no.txt"); }).find("No such file"), std::string::npos);
  EXPECT_NE(refusal([&] { readFile(folder.path()); }).find("is a folder"), std::string::npos);
}

TEST(AtomicFile, WritesADeviceInPlace) {
  writeFile("/dev/null", "gone", false);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, FollowsALinkAndReplacesTheFileAtItsEnd) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "home");
  fs::create_directory(folder / "scratch");
  put(folder / "scratch" / "a.txt", "old");
  fs::create_symlink("../scratch/a.txt", folder / "home" / "a.txt");
  fs::create_symlink("a.txt", folder / "home" / "b.txt"); // a link to a link
  EXPECT_NE(refusal([&] { writeFile(folder / "home" / "b.txt", "new", false); }).find("--force"), std::string::npos);
  const AtomicFile writing(folder / "home" / "b.txt", true);
  EXPECT_TRUE(fs::equivalent(writing.temporary().parent_path(), folder / "scratch")) << "no gigabytes at home";
  writeFile(folder / "home" / "b.txt", "new", true);
  EXPECT_TRUE(fs::is_symlink(folder / "home" / "b.txt") && fs::is_symlink(folder / "home" / "a.txt"));
  EXPECT_EQ(readFile(folder / "scratch" / "a.txt"), "new");
}

TEST(AtomicFile, WritesWhereALinkLeadsThatLedNowhere) {
  const TemporaryFolder folder;
  fs::create_symlink("new.txt", folder / "link.txt");
  fs::create_symlink("no/new.txt", folder / "lost.txt");
  fs::create_symlink("round.txt", folder / "round.txt");
  writeFile(folder / "link.txt", "new", false);
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(readFile(folder / "new.txt"), "new");
  EXPECT_NE(refusal([&] { writeFile(folder / "lost.txt", "new", false); }).find("No such file"), std::string::npos);
  EXPECT_NE(refusal([&] { writeFile(folder / "round.txt", "new", false); }).find("circle"), std::string::npos);
}

TEST(AtomicFile, KeepsTheModeOfTheFileThatItReplaces) {
  const TemporaryFolder folder;
  put(folder / "a.txt", "old");
  for (const auto mode : {fs::perms(0640), fs::perms(0600), fs::perms(0755)}) {
    fs::permissions(folder / "a.txt", mode);
    writeFile(folder / "a.txt", "new", true);
    EXPECT_EQ(fs::status(folder / "a.txt").permissions(), mode);
  }
}

TEST(AtomicFile, TakesATemporaryNameThatNobodyElseHas) {
  const TemporaryFolder folder;
  const AtomicFile one(folder / "a.txt", true), other(folder / "a.txt", true);
  EXPECT_NE(one.temporary(), other.temporary());
  const std::string longest(251, 'n');
  writeFile(folder / (longest + ".txt"), "new", false); // as long as the system takes
  EXPECT_EQ(readFile(folder / (longest + ".txt")), "new");
}

TEST(AtomicFile, RemovesWhatAKilledProcessLeftAndNothingElse) {
  const TemporaryFolder folder;
  put(folder / "a.txt", "old");
  killWhileWriting(folder / "a.txt");
  ASSERT_EQ(filesIn(folder.path()), 2) << "the old file and the temporary one";
  EXPECT_EQ(readFile(folder / "a.txt"), "old");
  put(folder / ".a.new-00000000-1-0.txt", "of another machine");
  put(folder / ".a.new-x.txt", "of nobody");
  const AtomicFile running(folder / "b.txt", false);
  writeFile(folder / "c.txt", "new", false);
  EXPECT_EQ(filesIn(folder.path()), 5) << "a, c, the running one's and two that are not ours";
}

TEST(AtomicFile, TriesBeforeTheWorkWhetherTheFileCanBeWritten) {
  const TemporaryFolder folder;
  requireWritable(folder / "a.txt", false);
  EXPECT_TRUE(fs::is_empty(folder.path()));
  EXPECT_NE(refusal([&] { requireWritable(folder / "no" / "a.txt", false); }).find("No such file"), std::string::npos);
  put(folder / "a.txt", "old");
  EXPECT_NE(refusal([&] { requireWritable(folder / "a.txt", false); }).find("--force"), std::string::npos);
  EXPECT_NE(refusal([&] { requireWritable("/proc/a.txt", false); }).find("cannot be written"), std::string::npos);
  requireWritable(folder / "a.txt", true);
  requireWritable("/dev/null", false);
  EXPECT_EQ(readFile(folder / "a.txt"), "old");
}

TEST(FilesTogether, ReplaceNothingUntilAllAreWritten) {
  const TemporaryFolder folder;
  put(folder / "a.txt", "old a");
  put(folder / "b.txt", "old b");
  {
    FilesTogether files(folder.path());
    files.add("a.txt", "new a");
    EXPECT_NE(refusal([&] { files.add("b.txt", [](const auto&) { throw Error("the disk is full"); }); }), "");
  }
  EXPECT_EQ(readFile(folder / "a.txt"), "old a");
  EXPECT_EQ(filesIn(folder.path()), 2);
  FilesTogether files(folder.path());
  files.add("a.txt", "new a");
  EXPECT_EQ(readFile(files.add("c.txt", "new c")), "new c") << "can be read back before";
  files.commit();
  EXPECT_EQ(readFile(folder / "a.txt") + readFile(folder / "c.txt"), "new anew c");
  EXPECT_EQ(filesIn(folder.path()), 3);
}

TEST(FilesTogether, NameTheFileThatWasAskedFor) {
  const TemporaryFolder folder;
  FilesTogether files(folder.path());
  const std::string sentence =
      refusal([&] { files.add("a.txt", [](const fs::path& beside) { throw Error(beside.string() + ": is wrong"); }); });
  EXPECT_EQ(sentence, (folder / "a.txt").string() + ": is wrong");
}

TEST(AtomicFile, NamesTheFinalFileInErrorsOfItsWriter) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a.txt", false);
  EXPECT_EQ(refusal([&] { file.fill([](const fs::path& path) { throw Error(path.string() + ": is wrong"); }); }),
            (folder / "a.txt").string() + ": is wrong");
  EXPECT_EQ(refusal([&] { file.fill([](const auto&) { throw Error("all is wrong"); }); }), "all is wrong");
}

TEST(AtomicFile, SaysThatTheDiskIsFull) {
  EXPECT_NE(refusal([] { writeFile("/dev/full", "x", false); }).find("No space left"), std::string::npos);
}

} // namespace
} // namespace palp
