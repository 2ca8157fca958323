// Sample files of arrays, HDF5 and NPZ. What h5py, NumPy and pandas read of them: tests/io/notebooks.py.

#include "io/AtomicFile.h"
#include "io/SampleFile.h"
#include "io/SamplePartWriter.h"
#include "io/samples/Npz.h"
#include "model/base/Cancelled.h"
#include "tests/app/gui/FullDisk.h"
#include "tests/io/Refusal.h"
#include "tests/io/SmallSamples.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <limits>

namespace palp {
namespace {

namespace fs = std::filesystem;

std::string sentenceOf(const fs::path& file) {
  return refusal([&] { loadSamples(file); });
}

void expectIn(const std::string& sentence, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
  EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
}

class SampleArrays : public testing::TestWithParam<const char*> {
protected:
  [[nodiscard]] fs::path file(const std::string& name) const { return folder / (name + GetParam()); }
  TemporaryFolder folder;
};

INSTANTIATE_TEST_SUITE_P(Each, SampleArrays, testing::Values(".h5", ".npz"),
                         [](const auto& each) { return std::string(each.param).substr(1); });

TEST(NpzFile, OfMoreNumbersThanCanBeCountedIsRefused) {
  const TemporaryFolder folder;
  const std::vector<std::uint64_t> huge(2, std::uint64_t{1} << 40U); // 2^80, of which 64 bits are 0
  EXPECT_EQ((NpyHead{"<f8", huge}.items()), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ((NpyHead{"<f8", {huge[0], huge[1], 0}}.items()), 0U);
  NpzWriter writer(folder / "a.npz");
  writer.begin("a", "<f8", huge);
  writer.end();
  writer.close();
  expectIn(refusal([&] { NpzArray(folder / "a.npz", "a"); }),
           {"array a", "another number of bytes than given in its head"});
}

TEST_P(SampleArrays, ReadBackTheSameNumbers) {
  for (const bool together : {false, true})
    for (const Eigen::Index size : {0, 1, 4096, 10'000}) { // one chunk exactly, and part of a third
      const SampleSet set = randomSet(size, 3, together);
      saveSamples(file("a"), set, true);
      expectSame(loadSamples(file("a")), set);
    }
}

TEST_P(SampleArrays, KeepTheTouches) {
  for (const Eigen::Index size : {1, 5000}) {
    const SampleSet set = randomTouches(size, 4);
    saveSamples(file("touches"), set, true);
    expectSame(loadSamples(file("touches")), set);
  }
  SampleSet wrong = randomTouches(3, 4);
  wrong.touches(kTouchShape, 1) = 6;
  saveSamples(file("wrong"), wrong, true);
  expectIn(sentenceOf(file("wrong")), {"sample 1", "shape: got 6, expected a whole number from 0 to 5"});
}

TEST_P(SampleArrays, KeepTwoTouchesAtOnceForWhoAsks) {
  const SampleSet set = randomPairs(40, 6);
  saveSamples(file("two"), set, false);
  expectSame(loadSamples(file("two"), {}, true), set);
  expectIn(sentenceOf(file("two")), {"got 2 together", "expected 1"});
  SampleSet wrong = set;
  wrong.secondTouch(kTouchShape, 2) = 0.5;
  saveSamples(file("wrong"), wrong, false);
  expectIn(refusal([&] { loadSamples(file("wrong"), {}, true); }), {"sample 2", "shape: got 0.5"});
}

TEST_P(SampleArrays, KeepTheHead) {
  SampleSet set = randomSet(2, 1);
  set.origin.seed = std::numeric_limits<std::uint64_t>::max();
  set.origin.firstSample = 12;
  set.origin.areas = "1"; // a text that looks like a number
  set.origin.designFingerprint = "1234567890123456";
  set.origin.solverTolerance = 1.0 / 3;
  set.origin.readout = Readout::OthersAtHalf;
  set.area.setOnes();
  saveSamples(file("a"), set, false);
  const SampleSet back = loadSamples(file("a"));
  expectSame(back, set);
  EXPECT_EQ(back.origin.readout, Readout::OthersAtHalf);
  EXPECT_EQ(sampleFileHead(back), sampleFileHead(set));
}

TEST_P(SampleArrays, KeepMeasuredTimesAndPlaces) {
  const SampleSet set = randomMeasured(9, 2);
  EXPECT_TRUE(set.origin.imported() && !randomSet(9, 2).origin.imported());
  saveSamples(file("a"), set, false);
  expectSame(loadSamples(file("a")), set);
  saveSamples(folder / "a.csv", set, false);
  expectSame(loadSamples(folder / "a.csv"), set);
  EXPECT_EQ(mergeSampleFiles({file("a")}, folder / "b.csv", false).samples, 9U);
  EXPECT_TRUE(readFile(folder / "b.csv") == readFile(folder / "a.csv"));
  EXPECT_NE(readFile(folder / "a.csv").find("\narea,time_s,x_mm,y_mm,fx_N,"), std::string::npos);

  SampleSet timeless = set; // of one request, but with another number of columns
  timeless.times_s.resize(0, 9);
  timeless.origin.firstSample = 9;
  saveSamples(file("c"), timeless, false);
  expectIn(refusal([&] { mergeSampleFiles({file("a"), file("c")}, file("x"), false); }), {"columns differ"});
}

TEST_P(SampleArrays, LeaveOutWhatNobodyKnows) {
  SampleSet set = randomSet(5, 1);
  set.displacements_mm.resize(0, 5);
  saveSamples(file("a"), set, false);
  EXPECT_EQ(loadSamples(file("a")).displacements_mm.rows(), 0);
  EXPECT_EQ(loadSamples(file("a")).resistances_ohm, set.resistances_ohm);
}

TEST_P(SampleArrays, AreKnownByTheirContentUnderAnyName) {
  const SampleSet set = randomSet(5, 1);
  saveSamples(file("a"), set, false);
  fs::rename(file("a"), folder / "a.csv");
  expectSame(loadSamples(folder / "a.csv"), set);
}

TEST_P(SampleArrays, MergeOfShardsOfAllFormatsIsTheBytesOfOneRun) {
  const SampleSet whole = randomSet(20, 5);
  saveSamples(file("whole"), whole, false);
  saveSamples(folder / "whole.csv", whole, false);
  std::vector<fs::path> parts;
  for (const auto& [first, count, ending] : {std::tuple{13, 7, ".csv"}, {0, 6, ".h5"}, {6, 7, ".npz"}}) {
    SampleSet part = slice(whole, first, count);
    part.origin.firstSample = static_cast<std::size_t>(first);
    parts.push_back(folder / ("part" + std::to_string(first) + ending));
    saveSamples(parts.back(), part, false);
  }
  EXPECT_EQ(mergeSampleFiles(parts, file("merged"), false).samples, 20U);
  EXPECT_TRUE(readFile(file("merged")) == readFile(file("whole")));
  EXPECT_EQ(mergeSampleFiles(parts, folder / "merged.csv", false).samples, 20U);
  EXPECT_TRUE(readFile(folder / "merged.csv") == readFile(folder / "whole.csv"));

  expectIn(refusal([&] { mergeSampleFiles({parts[0], parts[1]}, file("x"), false); }), {"missing"});
  expectIn(refusal([&] { mergeSampleFiles({parts[1], parts[2]}, file("x"), false); }), {"complete request has 20"});
  std::size_t left = 0;
  for ([[maybe_unused]] const auto& each : fs::directory_iterator(folder.path())) ++left;
  EXPECT_EQ(left, 7U); // two whole, three parts, two merged
}

TEST_P(SampleArrays, APartThatIsCutOffAnywhereBecomesTheBytesOfOneRun) {
  const SampleSet whole = randomSet(9, 2);
  saveSamples(file("whole"), whole, false);
  const std::string bytes = readFile(file("whole"));
  const fs::path part = file("a").string() + ".part";
  std::string all;
  {
    SamplePartWriter writer(file("a"), smallHead(), true);
    writer.append(whole);
    all = readFile(part);
  }
  for (std::size_t cut = 0; cut <= all.size(); cut += 61) {
    put(part, all.substr(0, cut));
    SamplePartWriter writer(file("a"), smallHead(), true);
    const auto kept = static_cast<Eigen::Index>(writer.samplesKept());
    ASSERT_LE(kept, 9);
    writer.append(slice(whole, kept, 9 - kept));
    writer.finish();
    ASSERT_TRUE(readFile(file("a")) == bytes) << "cut at " << cut;
  }
  EXPECT_FALSE(fs::exists(part));
}

TEST_P(SampleArrays, APartOfOtherWorkIsRefused) {
  { const SamplePartWriter writer(file("a"), smallHead(), false); }
  SampleSet head = smallHead();
  head.origin.mesh = "mapped 10x10x5";
  expectIn(refusal([&] { SamplePartWriter(file("a"), head, false); }), {"mesh differs"});
}

TEST_P(SampleArrays, StopLeavesThePartAndNothingElse) {
  std::stop_source stop;
  stop.request_stop();
  {
    SamplePartWriter writer(file("a"), smallHead(), false);
    writer.append(randomSet(9, 2));
    EXPECT_THROW(writer.finish(stop.get_token()), Cancelled);
  }
  EXPECT_EQ(SamplePartWriter(file("a"), smallHead(), false).samplesKept(), 9U);
  EXPECT_FALSE(fs::exists(file("a")));
  EXPECT_THROW(saveSamples(file("b"), randomSet(9, 2), false, stop.get_token()), Cancelled);
  EXPECT_FALSE(fs::exists(file("b")));
  saveSamples(file("c"), randomSet(9, 2), false);
  EXPECT_THROW(loadSamples(file("c"), stop.get_token()), Cancelled);
  EXPECT_THROW(mergeSampleFiles({file("c")}, file("d"), false, stop.get_token()), Cancelled);
  EXPECT_FALSE(fs::exists(file("d")));
}

TEST_P(SampleArrays, AFullDiskIsSaid) {
  fs::create_symlink("/dev/full", file("a"));
  expectIn(refusal([&] { saveSamples(file("a"), randomSet(600, 1), false); }),
           {file("a").filename().string() + ": cannot be written: No space left on device"});
  saveSamples(file("b"), randomSet(600, 1), false); // and the library goes on
  expectSame(loadSamples(file("b")), randomSet(600, 1));
}

TEST_P(SampleArrays, AFullDiskNamesTheFileAndNotTheTemporaryOne) {
  const std::string wanted = file("a").string() + ": cannot be written: ";
  const auto begins = [&](const std::string& sentence) { return sentence.substr(0, wanted.size()); };
  SamplePartWriter part(file("a"), smallHead(), false);
  part.append(randomSet(600, 1));
  const FullDisk little(20'000);
  EXPECT_EQ(begins(refusal([&] { part.finish(); })), wanted);
  EXPECT_EQ(begins(refusal([&] { saveSamples(file("a"), randomSet(600, 1), false); })), wanted);
  EXPECT_FALSE(fs::exists(file("a")));
}

TEST_P(SampleArrays, RefuseNumbersThatAreNotFiniteAndAreasThatAreNotThere) {
  SampleSet set = randomSet(300, 1);
  set.resistances_ohm(4, 270) = std::numeric_limits<double>::quiet_NaN();
  saveSamples(file("a"), set, false);
  expectIn(sentenceOf(file("a")), {"a" + std::string(GetParam()) + ", sample 270", "resistances_ohm", "nan", "finite"});
  set = randomSet(300, 1);
  set.area(299) = 2;
  saveSamples(file("b"), set, false);
  expectIn(sentenceOf(file("b")), {"sample 299", "area: got 2", "0 to 1"});
}

TEST_P(SampleArrays, RefuseAFileThatIsCutOffOrDamaged) {
  const SampleSet set = randomSet(600, 1);
  saveSamples(file("a"), set, false);
  const std::string bytes = readFile(file("a"));
  for (std::size_t cut = 8; cut < bytes.size(); cut += 2999) {
    put(file("b"), bytes.substr(0, cut));
    expectIn(sentenceOf(file("b")), {file("b").filename().string() + ": "});
  }
  int refused = 0;
  for (std::size_t at = 20; at < bytes.size(); at += bytes.size() / 50) {
    std::string damaged = bytes;
    damaged[at] ^= 0x10;
    put(file("b"), damaged);
    if (sentenceOf(file("b")).empty())
      expectSame(loadSamples(file("b")), set); // a byte that nobody uses
    else
      ++refused;
  }
  EXPECT_GT(refused, 25);
}

} // namespace
} // namespace palp
