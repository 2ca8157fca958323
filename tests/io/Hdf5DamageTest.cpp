// HDF5 files that are damaged, made to do harm, or held by another program. The library itself crashes on some of
// them and finds no end of others; it reads in a process of its own.

#include "io/AtomicFile.h"
#include "io/SampleFile.h"
#include "model/base/Cancelled.h"
#include "tests/io/Refusal.h"
#include "tests/io/SmallSamples.h"
#include "tests/io/TemporaryFolder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstring>
#include <random>
#include <thread>

namespace palp {
namespace {

class Hdf5Damage : public testing::Test {
protected:
  Hdf5Damage() {
    saveSamples(file, set, false);
    bytes = readFile(file);
  }
  /// Writes the file anew with these eight bytes at a place.
  void putNumber(std::size_t place, std::uint64_t number) {
    std::string damaged = bytes;
    std::memcpy(damaged.data() + place, &number, sizeof number);
    put(file, damaged);
  }
  /// Where the size of the first text among the attributes stands (HDF5 file format specification, III.E).
  [[nodiscard]] std::size_t firstTextSize() const { return bytes.find("GCOL") + 16 + 8; }

  TemporaryFolder folder;
  const std::filesystem::path file = folder / "samples.h5";
  const SampleSet set = randomSet(5, 1);
  std::string bytes;
};

TEST_F(Hdf5Damage, TextsWithoutEndAreRefused) {
  putNumber(firstTextSize(), std::uint64_t(0) - 16); // the next text begins where this one does
  const std::string sentence = refusal([&] { loadSamples(file); });
  EXPECT_EQ(sentence, file.string() + ": is damaged: reading it does not end");
}

TEST_F(Hdf5Damage, AStopEndsTheReadingOfAFileWithoutEnd) {
  putNumber(firstTextSize(), std::uint64_t(0) - 16);
  std::stop_source stop;
  const std::jthread asks([&stop] { stop.request_stop(); });
  EXPECT_THROW(loadSamples(file, stop.get_token()), Cancelled);
}

TEST_F(Hdf5Damage, TextsOfAnySizeEndInOneLine) {
  for (const std::uint64_t size : {0ULL, 1ULL, 0x100ULL, 0xffffULL, 1ULL << 40U, ~0ULL, ~0ULL - 6, 1ULL << 63U}) {
    putNumber(firstTextSize(), size);
    const std::string sentence = refusal([&] { loadSamples(file); });
    EXPECT_TRUE(sentence.empty() || sentence.starts_with(file.string())) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  }
}

TEST_F(Hdf5Damage, BytesByChanceEndInOneLineOrInNumbers) {
  std::mt19937 engine(1);
  const std::size_t heads = bytes.find("GCOL") + 4096; // what the library reads before the numbers
  int refused = 0;
  for (int variant = 0; variant < 30; ++variant) {
    std::string damaged = bytes;
    for (int change = 0; change < 8; ++change) damaged[engine() % heads] = static_cast<char>(engine());
    put(file, damaged);
    const std::string sentence = refusal([&] { loadSamples(file); });
    if (!sentence.empty()) ++refused;
    EXPECT_TRUE(sentence.empty() || sentence.starts_with(file.string())) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  }
  EXPECT_GT(refused, 5);
}

TEST_F(Hdf5Damage, AFileThatAnotherProgramHoldsIsReadOrNamed) {
  const int held = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(held, LOCK_EX | LOCK_NB), 0);
  expectSame(loadSamples(file), set);
  ASSERT_EQ(::ftruncate(held, 600), 0); // half written
  EXPECT_NE(refusal([&] { loadSamples(file); }).find("is open for writing in another program"), std::string::npos);
  ::close(held);
  EXPECT_NE(refusal([&] { loadSamples(file); }).find("is damaged"), std::string::npos);
}

} // namespace
} // namespace palp
