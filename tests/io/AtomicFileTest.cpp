#include "io/AtomicFile.h"

#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <iterator>

namespace palp {
namespace {

TEST(AtomicFile, WritesTheWholeFileAndLeavesNothingBeside) {
  const TemporaryFolder folder;
  writeFile(folder / "a.txt", "first", false);
  EXPECT_EQ(readFile(folder / "a.txt"), "first");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
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
    EXPECT_EQ(file.beside().extension(), ".png");
    put(file.beside(), "half");
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

TEST(AtomicFile, SaysThatTheDiskIsFull) {
  EXPECT_NE(refusal([] { writeFile("/dev/full", "x", false); }).find("No space left"), std::string::npos);
}

} // namespace
} // namespace palp
