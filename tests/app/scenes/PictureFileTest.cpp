#include "app/scenes/Picture.h"

#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace palp {
namespace {

TEST(PictureFile, SaysWhyItCannotBeWritten) {
  const std::string words = refusal([] { writePng({1, 1, {0, 0, 0}}, "/no/such/folder/a.png"); });
  EXPECT_EQ(words, "/no/such/folder/a.png: cannot be written: No such file or directory");
}

TEST(PictureFile, SaysThatTheDiskIsFull) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const std::string words = refusal([] { writePng({1, 1, {0, 0, 0}}, "/dev/full"); });
  EXPECT_EQ(words, "/dev/full: cannot be written: No space left on device");
}

} // namespace
} // namespace palp
