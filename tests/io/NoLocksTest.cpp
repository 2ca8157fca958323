#include "io/SampleFile.h"
#include "io/SamplePartWriter.h"
#include "tests/io/Refusal.h"
#include "tests/io/SmallSamples.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <sys/file.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

namespace {
int flockFails = 0; ///< errno of it; 0: as the system does
} // namespace

/// In place of the C library's, for all of this program.
extern "C" int flock(int file, int operation) noexcept {
  errno = flockFails;
  return flockFails != 0 ? -1 : static_cast<int>(::syscall(SYS_flock, file, operation));
}

namespace palp {
namespace {

class NoLocks : public testing::TestWithParam<int> {
protected:
  ~NoLocks() override { flockFails = 0; }
};

/// As NFS, Lustre and others do that are mounted without locks.
TEST_P(NoLocks, SamplesAreWrittenUnlocked) {
  const TemporaryFolder folder;
  flockFails = GetParam();
  for (const char* name : {"a.csv", "a.npz"}) {
    SamplePartWriter writer(folder / name, smallHead(), false);
    writer.append(randomSet(9, 2));
    writer.finish();
    EXPECT_EQ(loadSamples(folder / name).size(), 9);
  }
}

INSTANTIATE_TEST_SUITE_P(Errors, NoLocks, testing::Values(ENOLCK, ENOSYS, EOPNOTSUPP, EINVAL));

TEST(Locks, TellThatAnotherProcessIsWriting) {
  const TemporaryFolder folder;
  const SamplePartWriter writer(folder / "a.csv", smallHead(), false);
  EXPECT_NE(refusal([&] { SamplePartWriter(folder / "a.csv", smallHead(), false); }).find("another process"),
            std::string::npos);
}

TEST(Links, LeadThePartAndTheSamplesToTheirEnd) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "scratch");
  for (const std::string name : {"a.csv", "a.npz"}) {
    std::filesystem::create_symlink("scratch/" + name, folder / name);
    SamplePartWriter writer(folder / name, smallHead(), false);
    EXPECT_TRUE(std::filesystem::exists(folder / ("scratch/" + name + ".part"))) << "gigabytes beside their end";
    writer.append(randomSet(9, 2));
    writer.finish();
    EXPECT_TRUE(std::filesystem::is_symlink(folder / name));
    EXPECT_EQ(loadSamples(folder / ("scratch/" + name)).size(), 9);
    EXPECT_FALSE(std::filesystem::exists(folder / ("scratch/" + name + ".part")));
  }
}

} // namespace
} // namespace palp
