#include "io/SampleFile.h"

#include "io/AtomicFile.h"
#include "io/SamplePartWriter.h"
#include "tests/io/Refusal.h"
#include "tests/io/SmallSamples.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(SampleFile, ReadsBackTheSameNumbers) {
  const TemporaryFolder folder;
  for (const bool together : {false, true}) {
    const SampleSet set = randomSet(1000, 3, together);
    saveSamples(folder / "a.csv", set, true);
    expectSame(loadSamples(folder / "a.csv"), set);
  }
}

TEST(SampleFile, OfTwoTouchesAtOnceIsForWhoAsks) {
  const TemporaryFolder folder;
  const SampleSet set = randomPairs(40, 6);
  saveSamples(folder / "a.csv", set, false);
  expectSame(loadSamples(folder / "a.csv", {}, true), set);
  EXPECT_NE(sampleFileHead(set).find(",fz_N,shape_2,size_2_mm,friction_2,x_2_mm,y_2_mm,fx_2_N,fy_2_N,fz_2_N,u_r0_e0"),
            std::string::npos);
  EXPECT_NE(refusal([&] { loadSamples(folder / "a.csv"); }).find("got 2 together"), std::string::npos);
}

TEST(SampleFile, LeavesOutWhatNobodyKnows) {
  const TemporaryFolder folder;
  SampleSet set = randomSet(5, 1);
  set.displacements_mm.resize(0, 5);
  saveSamples(folder / "a.csv", set, false);
  const SampleSet back = loadSamples(folder / "a.csv");
  EXPECT_EQ(back.displacements_mm.rows(), 0);
  EXPECT_EQ(back.resistances_ohm, set.resistances_ohm);
}

TEST(SampleFile, SaysTheReadOutWhereThereIsOne) {
  const TemporaryFolder folder;
  SampleSet set = randomSet(2, 1);
  EXPECT_EQ(sampleFileHead(set).find("readout"), std::string::npos); // files of Eq. (1) are as they were
  set.origin.readout = Readout::OthersAtHalf;
  saveSamples(folder / "a.csv", set, false);
  EXPECT_EQ(loadSamples(folder / "a.csv").origin.readout, Readout::OthersAtHalf);
  std::string text = readFile(folder / "a.csv");
  text.replace(text.find("others_at_half"), 14, "others_at_rest");
  put(folder / "b.csv", text);
  EXPECT_NE(refusal([&] { loadSamples(folder / "b.csv"); }).find("readout: got \"others_at_rest\""), std::string::npos);
}

TEST(SampleFile, NamesItsColumnsWithTheirUnits) {
  const std::string head = sampleFileHead(smallHead());
  for (const char* part : {"# seed: 7\n", "# kind: full solves\n", "\narea,fx_N,fy_N,fz_N,u_r0_e0_x_mm,",
                           ",u_r1_e1_z_mm,R_r0_c0_ohm,", ",R_r1_c2_ohm\n"})
    EXPECT_NE(head.find(part), std::string::npos) << part;
  EXPECT_NE(sampleFileHead(smallHead(true)).find("\narea,a0_fx_N,a0_fy_N,a0_fz_N,a1_fx_N,"), std::string::npos);
}

TEST(SampleFile, AcceptsLineEndsOfWindows) {
  const TemporaryFolder folder;
  const SampleSet set = randomSet(3, 1);
  saveSamples(folder / "a.csv", set, false);
  std::string text = readFile(folder / "a.csv");
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  put(folder / "b.csv", text);
  expectSame(loadSamples(folder / "b.csv"), set);
}

struct FileSlip {
  const char* name;
  std::function<void(std::string&)> damage;
  std::vector<const char*> sentence;
};

void PrintTo(const FileSlip& slip, std::ostream* out) {
  *out << slip.name;
}

class SampleFileSlip : public testing::TestWithParam<FileSlip> {};

std::function<void(std::string&)> replaced(const std::string& piece, const std::string& by) {
  return [=](std::string& text) {
    ASSERT_NE(text.find(piece), std::string::npos) << piece;
    text.replace(text.find(piece), piece.size(), by);
  };
}

TEST_P(SampleFileSlip, IsRefusedWithItsLine) {
  const TemporaryFolder folder;
  SampleSet set = randomSet(3, 1);
  set.forces_N.setConstant(0.25);
  saveSamples(folder / "a.csv", set, false);
  std::string text = readFile(folder / "a.csv");
  GetParam().damage(text);
  put(folder / "b.csv", text);
  const std::string sentence = refusal([&] { loadSamples(folder / "b.csv"); });
  EXPECT_NE(sentence.find("b.csv, line "), std::string::npos) << sentence;
  for (const char* part : GetParam().sentence) EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
}

INSTANTIATE_TEST_SUITE_P(
    Each, SampleFileSlip,
    testing::Values(
        FileSlip{"NotANumber", replaced("0,0.25", "0,x"), {"line 16", "field 2", "\"x\""}},
        FileSlip{"Nan", replaced("0,0.25", "0,nan"), {"line 16", "nan", "finite"}},
        FileSlip{"Infinite", replaced("0,0.25", "0,inf"), {"line 16", "inf", "finite"}},
        FileSlip{"TooLarge", replaced("0,0.25", "0,1e999"), {"line 16", "1e999"}},
        FileSlip{"Empty", replaced("0,0.25", "0,"), {"line 16", "field 2"}},
        FileSlip{"FieldMissing", replaced("0,0.25,", "0,"), {"line 16", "fields: got 21", "22"}},
        FileSlip{"AreaUnknown", replaced("\n0,0.25", "\n2,0.25"), {"line 16", "area: got 2", "0 to 1"}},
        FileSlip{"AreaOfAllInAFileOfSingleAreas",
                 replaced("\n0,0.25", "\n-1,0.25"),
                 {"line 16", "area: got -1", "expected 0 to 1"}},
        FileSlip{"AreaBroken", replaced("\n0,0.25", "\n0.5,0.25"), {"line 16", "field 1", "0.5"}},
        FileSlip{"CutOff", [](std::string& text) { text.resize(text.size() - 5); }, {"line 18", "cut off"}},
        FileSlip{"HeadLineMissing", replaced("# seed: 7\n", ""), {"seed"}},
        FileSlip{"HeadLineTwice", replaced("# seed: 7\n", "# seed: 7\n# seed: 8\n"), {"seed appears twice"}},
        FileSlip{"HeadKeyUnknown", replaced("# seed: 7\n", "# seed: 7\n# salt: 8\n"), {"unknown key", "salt"}},
        FileSlip{"HeadNumberBroken", replaced("# seed: 7", "# seed: -7"), {"seed", "-7"}},
        FileSlip{"CountOfZero", replaced("area_count: 2", "area_count: 0"), {"area_count: got 0", "1 or more"}},
        FileSlip{"CountsBeyondAllReason", // their product is no int, and their names would fill the memory
                 [](std::string& text) {
                   replaced("row_wires: 2", "row_wires: 100000")(text);
                   replaced("electrodes_per_row_wire: 2", "electrodes_per_row_wire: 100000")(text);
                 },
                 {"line 15", "columns: got 22", "30000300004"}},
        FileSlip{"KindUnknown", replaced("full solves", "guess"), {"guess", "full solves or surrogate"}},
        FileSlip{"Newer", replaced("palp_samples: 1", "palp_samples: 2"), {"version: got 2"}},
        FileSlip{"ColumnRenamed", replaced("fy_N", "fy_kN"), {"column 3", "fy_kN", "fy_N"}},
        FileSlip{"ColumnMissing", replaced(",R_r1_c2_ohm", ""), {"columns", "22"}},
        FileSlip{"NoHeadAtAll", [](std::string& text) { text.erase(0, text.find("area,")); }, {"palp_samples"}}),
    [](const auto& each) { return each.param.name; });

TEST(SampleFile, OfAreasLoadedTogetherNamesNoSingleOne) {
  const TemporaryFolder folder;
  saveSamples(folder / "a.csv", randomSet(3, 1, true), false);
  std::string text = readFile(folder / "a.csv");
  replaced("\n-1,", "\n1,")(text);
  put(folder / "b.csv", text);
  const std::string sentence = refusal([&] { loadSamples(folder / "b.csv"); });
  EXPECT_NE(sentence.find("b.csv, line 16: area: got 1, expected -1"), std::string::npos) << sentence;
}

TEST(SampleFile, MergeOfShardsInAnyOrderIsTheBytesOfOneRun) {
  const TemporaryFolder folder;
  const SampleSet whole = randomSet(20, 5);
  saveSamples(folder / "whole.csv", whole, false);
  std::vector<std::filesystem::path> parts;
  for (const auto& [first, count] : {std::pair{13, 7}, {0, 6}, {6, 7}}) {
    SampleSet part = slice(whole, first, count);
    part.origin.firstSample = static_cast<std::size_t>(first);
    parts.push_back(folder / ("part" + std::to_string(first)));
    saveSamples(parts.back(), part, false);
  }
  EXPECT_EQ(mergeSampleFiles(parts, folder / "merged.csv", false).samples, 20U);
  EXPECT_EQ(readFile(folder / "merged.csv"), readFile(folder / "whole.csv"));

  EXPECT_NE(refusal([&] {
              mergeSampleFiles({parts[0], parts[1]}, folder / "x", false);
            }).find("missing"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              mergeSampleFiles({parts[1], parts[1]}, folder / "x", false);
            }).find("twice"),
            std::string::npos);
  EXPECT_NE(refusal([&] {
              mergeSampleFiles({parts[1], parts[2]}, folder / "x", false);
            }).find("complete request has 20"),
            std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "x"));
}

TEST(SampleFile, MergeWarnsOfShardsOfSeveralProgramsAndNamesThem) {
  const TemporaryFolder folder;
  const SampleSet whole = randomSet(20, 5);
  std::vector<std::filesystem::path> parts;
  const auto write = [&](int first, int count, const std::string& by, const std::string& ending) {
    SampleSet part = slice(whole, first, count);
    part.origin.firstSample = static_cast<std::size_t>(first);
    part.origin.madeBy = by;
    parts.push_back(folder / (std::to_string(first) + ending));
    saveSamples(parts.back(), part, false);
  };
  write(0, 6, "palp 1, avx2", ".csv");
  write(6, 7, "palp 1, avx512", ".h5");
  EXPECT_EQ(loadSamples(parts[1]).origin.madeBy, "palp 1, avx512");
  write(13, 7, "palp 1, avx2", ".npz");
  const MergedSamples merged = mergeSampleFiles(parts, folder / "all.csv", false);
  EXPECT_NE(merged.warning.find("palp 1, avx2; palp 1, avx512"), std::string::npos) << merged.warning;
  EXPECT_EQ(loadSamples(folder / "all.csv").origin.madeBy, "palp 1, avx2; palp 1, avx512");
  write(6, 7, "palp 1, avx2", ".csv");
  EXPECT_EQ(mergeSampleFiles({parts[0], parts[2], parts[3]}, folder / "one.csv", false).warning, "");
  write(13, 7, "", ".csv"); // of a program that named nobody
  EXPECT_NE(mergeSampleFiles({parts[0], parts[3], parts[4]}, folder / "old.csv", false).warning.find("; unknown"),
            std::string::npos);
}

TEST(SampleFile, MergeRefusesShardsOfOtherWork) {
  const TemporaryFolder folder;
  saveSamples(folder / "a", randomSet(10, 5), false);
  SampleSet other = randomSet(10, 5);
  other.origin.seed = 8;
  saveSamples(folder / "b", other, false);
  const std::string sentence = refusal([&] { mergeSampleFiles({folder / "a", folder / "b"}, folder / "x", false); });
  EXPECT_NE(sentence.find("seed differs: 7 and 8"), std::string::npos) << sentence;
}

TEST(SamplePartWriter, WritesTheBytesOfOneRunWhereverItIsCutOff) {
  const TemporaryFolder folder;
  const SampleSet whole = randomSet(9, 2);
  saveSamples(folder / "whole.csv", whole, false);
  const std::string bytes = readFile(folder / "whole.csv");
  for (std::size_t cut = 0; cut <= bytes.size(); cut += 37) {
    put(folder / "a.csv.part", bytes.substr(0, cut));
    SamplePartWriter writer(folder / "a.csv", smallHead(), true);
    const auto kept = static_cast<Eigen::Index>(writer.samplesKept());
    ASSERT_LE(kept, 9);
    writer.append(slice(whole, kept, 9 - kept));
    writer.finish();
    ASSERT_EQ(readFile(folder / "a.csv"), bytes) << "cut at " << cut;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.csv.part"));
}

TEST(SamplePartWriter, KeepsAPartThatIsWhole) {
  const TemporaryFolder folder;
  saveSamples(folder / "a.csv.part", randomSet(9, 2), false);
  EXPECT_EQ(SamplePartWriter(folder / "a.csv", smallHead(), false).samplesKept(), 9U);
}

TEST(SamplePartWriter, SaysWhatDiffersFromThePartThatIsThere) {
  const TemporaryFolder folder;
  saveSamples(folder / "a.csv.part", randomSet(9, 2), false);
  SampleSet head = smallHead();
  head.origin.mesh = "mapped 10x10x5";
  const std::string other = refusal([&] { SamplePartWriter(folder / "a.csv", head, false); });
  EXPECT_NE(other.find("mesh differs: tetrahedra, 2 mm and mapped 10x10x5"), std::string::npos) << other;
  head = smallHead();
  head.origin.firstSample = 5;
  EXPECT_NE(refusal([&] { SamplePartWriter(folder / "a.csv", head, false); }).find("shard"), std::string::npos);
  EXPECT_EQ(loadSamples(folder / "a.csv.part").size(), 9); // untouched
}

TEST(SamplePartWriter, RefusesBeforeTheWorkWhatItCouldNotFinish) {
  const TemporaryFolder folder;
  put(folder / "a.csv", "precious");
  EXPECT_NE(refusal([&] { SamplePartWriter(folder / "a.csv", smallHead(), false); }).find("--force"),
            std::string::npos);
  const SamplePartWriter first(folder / "b.csv", smallHead(), false);
  EXPECT_NE(refusal([&] { SamplePartWriter(folder / "b.csv", smallHead(), false); }).find("another process"),
            std::string::npos);
}

TEST(SamplePartWriter, RefusesToContinueSamplesOfAnotherProgram) {
  const TemporaryFolder folder;
  SampleSet head = smallHead();
  head.origin.madeBy = "palp 1, avx2";
  {
    SamplePartWriter writer(folder / "a.csv", head, false);
    writer.append(randomSet(9, 2));
  }
  for (const char* other : {"palp 2, avx2", "palp 1, avx512", ""}) {
    SampleSet now = head;
    now.origin.madeBy = other;
    const std::string sentence = refusal([&] { SamplePartWriter(folder / "a.csv", now, false); });
    EXPECT_NE(sentence.find("samples were made by palp 1, avx2, this is " + std::string(other)), std::string::npos)
        << sentence;
  }
  SamplePartWriter writer(folder / "a.csv", head, false);
  EXPECT_EQ(writer.samplesKept(), 9U);
  writer.finish();
  EXPECT_EQ(loadSamples(folder / "a.csv").origin.madeBy, "palp 1, avx2");
}

} // namespace
} // namespace palp
