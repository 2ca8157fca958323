#include "io/ImportDraft.h"

#include "io/AtomicFile.h"
#include "io/ImportSamples.h"
#include "io/SampleFile.h"
#include "io/StrictJson.h"
#include "io/samples/Npz.h"
#include "model/base/Error.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <span>

namespace palp {

namespace {

using Meaning = ColumnMeaning;

class ImportDraftTest : public testing::Test {
protected:
  void table(const std::string& name, const std::string& content) {
    writeFile(folder_ / name, content, true);
    files_.push_back(folder_ / name);
    tables_.push_back(previewTable(files_.back(), {}));
  }
  /// The draft as the names of the columns propose it.
  void guess() { draft_ = importDraft(guessPartOfMap(tables_).json, tables_); }
  void set(std::vector<ColumnPlace> columns, Meaning meaning) { assign(draft_, tables_, columns, meaning); }
  [[nodiscard]] Json map() const { return Json::parse(mapText(draft_, tables_)); }
  [[nodiscard]] std::string refusal() const {
    try {
      ImportRequest request{files_};
      request.mapText = mapText(draft_, tables_);
      checkImport(request, {}, {});
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }
  [[nodiscard]] SampleSet samples() const {
    ImportRequest request{files_, {}, nullptr, folder_ / "samples.csv", true};
    request.mapText = mapText(draft_, tables_);
    importSamples(request, {}, {});
    return loadSamples(folder_ / "samples.csv");
  }

  TemporaryFolder folder_;
  std::vector<std::filesystem::path> files_;
  std::vector<TablePreview> tables_;
  ImportDraft draft_;
};

constexpr const char* kNamed = "t_ms,ch1,ch2,Fx [mN],Fz [mN]\n0,1,2,3,4\n1,2,1,4,3\n2,3,4,5,6\n";
constexpr const char* kUnnamed = "0 1.5 2.5 3\n1 2.5 1.5 4\n2 3.5 2.5 5\n";

TEST_F(ImportDraftTest, TheGuessStaysAsItIs) {
  table("table.csv", kNamed);
  const std::string guessed = guessImportMap(files_).json;
  guess();
  EXPECT_EQ(map(), Json::parse(guessed));
  EXPECT_EQ(draft_.meanings[0],
            (std::vector{Meaning::Time, Meaning::Reading, Meaning::Reading, Meaning::Fx, Meaning::Fz}));
  EXPECT_EQ(draft_.forceUnit, "mN");
  EXPECT_EQ(draft_.timeUnit, "ms");
  EXPECT_EQ(refusal(), "");
}

TEST_F(ImportDraftTest, ATableWithoutNamesIsAssignedColumnByColumn) {
  table("table.txt", kUnnamed);
  guess();
  EXPECT_NE(guessPartOfMap(tables_).missing.find("no names of columns"), std::string::npos);
  EXPECT_EQ(refusal(), "no column is a reading yet");
  set({{0, 1}, {0, 2}}, Meaning::Reading);
  EXPECT_EQ(refusal(), "no column is a force or a position yet");
  set({{0, 3}}, Meaning::Fz);
  EXPECT_NE(refusal().find("forces: has no \"unit\""), std::string::npos) << "in the words of the command line";
  draft_.forceUnit = "gf";
  EXPECT_EQ(refusal(), "");
  set({{0, 0}}, Meaning::Time);
  draft_.timeUnit = "min";
  draft_.inverted = {false, false, true};
  const SampleSet set = samples();
  EXPECT_EQ(set.resistances_ohm, (Eigen::MatrixXd(2, 3) << 1.5, 2.5, 3.5, 2.5, 1.5, 2.5).finished());
  EXPECT_NEAR(set.forces_N(2, 2), -5 * 9.80665e-3, 1e-12);
  EXPECT_EQ(set.times_s(0, 2), 120);
  const ImportDraft again = importDraft(mapText(draft_, tables_), tables_);
  EXPECT_EQ(again.meanings, draft_.meanings);
  EXPECT_EQ(again.inverted, draft_.inverted);
}

TEST_F(ImportDraftTest, OneColumnReplacesAnotherAndForcesAssignedTogetherAreSummed) {
  table("table.csv", kNamed);
  guess();
  set({{0, 3}}, Meaning::Fz);
  EXPECT_EQ(draft_.meanings[0][4], Meaning::LeftOut);
  EXPECT_EQ(map()["forces"]["columns"], (Json{nullptr, nullptr, "Fx [mN]"}));
  set({{0, 3}, {0, 4}}, Meaning::Fz);
  EXPECT_EQ(map()["forces"]["columns"][2], (Json{{"sum", {"Fx [mN]", "Fz [mN]"}}}));
  set({{0, 1}, {0, 2}}, Meaning::Time);
  EXPECT_EQ(draft_.meanings[0][2], Meaning::Reading) << "there is one time";
}

TEST_F(ImportDraftTest, WhatADraftCannotExpressStaysAsLongAsItsColumnsDo) {
  table("table.csv", kNamed);
  const std::string text = R"({"palp_import": 1, "about": "a rig", "signals": {"columns": ["ch2", "ch1"]},)"
                           R"("forces": {"columns": [{"column": "Fx [mN]", "factor": 2}, null, )"
                           R"({"sum": ["Fz [mN]"], "offset": -3}], "signs": [1, 1, -1]}})";
  draft_ = importDraft(text, tables_);
  EXPECT_EQ(map(), Json::parse(text));
  EXPECT_TRUE(draft_.inverted[2]);
  draft_.kind = ReadingKind::DividerLow;
  draft_.fullScale = 5;
  draft_.resistor_ohm = 1000;
  set({{0, 4}}, Meaning::Fy);
  Json expected = Json::parse(text);
  expected["resistances"] = {
      {"columns", {"ch2", "ch1"}}, {"divider", "low"}, {"full_scale", 5.0}, {"resistor_ohm", 1000.0}};
  expected.erase("signals");
  expected["forces"]["columns"][1] = "Fz [mN]";
  expected["forces"]["columns"][2] = nullptr;
  expected["forces"]["unit"] = "mN"; // as the table states
  EXPECT_EQ(map(), expected);
}

TEST_F(ImportDraftTest, ReadingsStayInTheOrderOfTheMap) {
  table("table.csv", "extra,R1_0,R1_1,R0_0,R0_1,Fz_N\n1,2,3,4,5,-1\n2,3,4,5,6,-2\n");
  guess();
  EXPECT_EQ(map()["resistances"]["columns"], (Json{"R0_0", "R0_1", "R1_0", "R1_1"}));
  EXPECT_EQ(draft_.rowWires, 2);
  set({{0, 2}, {0, 4}}, Meaning::LeftOut);
  set({{0, 0}}, Meaning::Reading);
  draft_.rowWires = 1;
  EXPECT_EQ(map()["resistances"]["columns"], (Json{"R0_0", "R1_0", "extra"}));
}

TEST_F(ImportDraftTest, ValuesOfAnotherTableHaveTheirOwnClock) {
  table("readings.txt", "7 0\n8 1\n9 2\n");
  table("forces.txt", "1 0\n3 1\n5 2\n");
  guess();
  set({{0, 0}}, Meaning::Reading);
  set({{0, 1}}, Meaning::Time);
  set({{1, 0}}, Meaning::Fz);
  EXPECT_NE(refusal().find("forces: has no"), std::string::npos);
  draft_.forceUnit = "N";
  draft_.timeUnit = "s";
  EXPECT_EQ(refusal(), "");
  EXPECT_FALSE(map()["forces"].contains("time")) << "row by row";
  set({{1, 1}}, Meaning::ForceTime);
  EXPECT_EQ(map()["forces"]["time"], (Json{{"column", 2}, {"unit", "s"}}));
  EXPECT_EQ(map()["forces"]["table"], 2);
  EXPECT_EQ(samples().forces_N.row(2), Eigen::RowVector3d(1, 3, 5));
  set({{1, 1}}, Meaning::Time);
  EXPECT_NE(refusal().find("Time: column 2 of forces.txt; expected a column of readings.txt"), std::string::npos)
      << refusal();
}

TEST_F(ImportDraftTest, SaysWhatIsMissing) {
  table("a.csv", kNamed);
  table("b.csv", "x,y,F\n1,2,3\n1,2,3\n");
  guess();
  EXPECT_EQ(tablesOfOneRun(tables_), 2U);
  set({{1, 2}}, Meaning::Fy);
  EXPECT_NE(refusal().find("forces: Fx [mN] of a.csv and F of b.csv are in different tables"), std::string::npos)
      << refusal();
  for (const std::size_t column : {0, 1, 2}) set({{1, column}}, Meaning::LeftOut);
  EXPECT_EQ(refusal(), "b.csv: none of its columns is used yet");
  set({{1, 0}}, Meaning::X);
  EXPECT_EQ(refusal(), "a position needs two columns, x and y");
  draft_.rowWires = 3;
  EXPECT_EQ(refusal(), "2 readings cannot be of 3 row-wires with equally many column-wires");
}

TEST_F(ImportDraftTest, ShowsWhatATableIs) {
  table("table.txt", "Logger 3\n\nt;F\n[s];[kN]\n1,5;2\n2,5;3\n");
  EXPECT_EQ(tables_[0].before, (std::vector<std::string>{"Logger 3"}));
  EXPECT_EQ(tables_[0].columns[1].unit, "kN");
  EXPECT_EQ(tables_[0].rows, (std::vector<std::vector<std::string>>{{"1,5", "2"}, {"2,5", "3"}}));
  TextForm form;
  form.namesLine = 1;
  form.separator = ';';
  EXPECT_EQ(previewTable(files_[0], form).columns[0].name, "Logger 3");
  EXPECT_EQ(mapFileOf("run/table.txt"), "run/table.txt.map.json");
  table("same.txt", "t;F\n1,5;2\n");
  EXPECT_EQ(tablesOfOneRun(tables_), 1U) << "another recording";
}

TEST_F(ImportDraftTest, ShowsTheArraysOfAFile) {
  const std::filesystem::path file = folder_ / "arrays.npz";
  NpzWriter writer(file);
  const auto add = [&writer](const std::string& name, const std::vector<std::uint64_t>& shape,
                             const std::vector<double>& values) {
    writer.begin(name, "<f8", shape);
    writer.write({reinterpret_cast<const unsigned char*>(values.data()), 8 * values.size()});
    writer.end();
  };
  add("F", {3, 2}, {1, 2, 3, 4, 5, 6});
  add("other", {2}, {7, 8});
  writer.close();
  const TablePreview preview = previewTable(file, {});
  ASSERT_EQ(preview.arrays.size(), 2U);
  EXPECT_EQ(preview.arrays[0].rows, 3U);
  EXPECT_EQ(preview.arrays[0].columns, 2U);
  EXPECT_EQ(preview.columns[1].name, "F[1]");
  EXPECT_EQ(preview.rows, (std::vector<std::vector<std::string>>{{"1", "2", "7"}, {"3", "4", "8"}, {"5", "6", ""}}));
  EXPECT_FALSE(hasSampleArrays(file));
}

} // namespace

} // namespace palp
