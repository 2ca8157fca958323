#include "io/AtomicFile.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <string>
#include <vector>

namespace {
std::vector<std::string> steps; ///< of the system's calls, with the name of the file or folder
bool watched = false;
} // namespace

/// In place of the C library's, for all of this program.
extern "C" int fsync(int file) {
  std::string name = "/proc/self/fd/" + std::to_string(file);
  if (watched) steps.push_back("sync " + std::filesystem::read_symlink(name).filename().string());
  return static_cast<int>(::syscall(SYS_fsync, file));
}
extern "C" int rename(const char* from, const char* to) noexcept {
  if (watched) steps.push_back("rename " + std::filesystem::path(from).filename().string());
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

namespace palp {
namespace {

/// After a power cut the name must not lead to an empty file, and must be there.
TEST(AtomicFile, IsSynchronisedBeforeItHasItsNameAndItsFolderAfterwards) {
  const TemporaryFolder folder;
  AtomicFile file(folder / "a.txt", false);
  put(file.temporary(), "new");
  const std::string temporary = file.temporary().filename().string();
  steps.clear();
  watched = true;
  file.commit();
  watched = false;
  EXPECT_EQ(steps, (std::vector<std::string>{"sync " + temporary, "rename " + temporary,
                                             "sync " + folder.path().filename().string()}));
}

} // namespace
} // namespace palp
