#include "io/measured/MeasuredTable.h"

#include "io/AtomicFile.h"
#include "io/ImportSamples.h"
#include "io/SampleFile.h"
#include "io/measured/Units.h"
#include "model/base/Error.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace palp {

namespace {

using Table = std::vector<std::vector<double>>;

class MeasuredTableTest : public testing::Test {
protected:
  std::filesystem::path file(const std::string& name, const std::string& content) {
    const std::filesystem::path path = folder_.path() / name;
    writeFile(path, content, true);
    return path;
  }

  /// All rows of the columns; problems end with "!".
  Table rows(const std::string& content, std::vector<ChosenColumn> chosen, const TableForm& form = {}) {
    table_ = openTable(file("table.txt", content), form);
    const std::size_t count = chosen.size();
    table_->choose(std::move(chosen));
    Table all;
    std::vector<double> values(count);
    problems_.clear();
    for (std::size_t before = 0; table_->next(values, problems_); before = problems_.size())
      if (problems_.size() == before) all.push_back(values);
    return all;
  }

  TemporaryFolder folder_;
  std::unique_ptr<MeasuredTable> table_;
  std::vector<std::string> problems_;
};

const Table kTwo{{1.5, -2}, {2.5, 3e3}};
const std::vector<ChosenColumn> kFirstTwo{{0}, {1}};

TEST_F(MeasuredTableTest, ReadsEverySeparatorAndDecimalSign) {
  EXPECT_EQ(rows("a,b\n1.5,-2\n2.5,3e3\n", kFirstTwo), kTwo);
  EXPECT_EQ(rows("a;b\r\n1,5;-2\r\n2,5;3e3\r\n", kFirstTwo), kTwo);
  EXPECT_EQ(rows("a\tb\r1.5\t-2\r2.5\t+3D+03\r", kFirstTwo), kTwo);
  EXPECT_EQ(rows("  1,5   -2 \n\n  2,5 \t 3000\n", kFirstTwo), kTwo);
  EXPECT_EQ(rows("\"a\", \"b, c\"\n\"1.5\", -2\n2.5,\"3e3\"\n", kFirstTwo), kTwo);
  EXPECT_EQ(table_->columns().at(1), "b, c");
  EXPECT_EQ(rows("a,b\n\"1,5\",\"-2\"\n\"2,5\",\"3000\"\n", kFirstTwo), kTwo) << "decimal commas in quotes";
}

TEST_F(MeasuredTableTest, FindsNamesAndUnitsBelowAPreamble) {
  EXPECT_EQ(rows("Logger 3000\nSerial: 17\n\nt;F\n[s];[mN]\n1,5;-2\n2,5;3000\n", kFirstTwo), kTwo);
  EXPECT_EQ(table_->columns(), (std::vector<std::string>{"t", "F"}));
  EXPECT_EQ(table_->units(), (std::vector<std::string>{"[s]", "[mN]"}));
  EXPECT_NE(table_->form().find("names in line 4, units in line 5, first row in line 6"), std::string::npos);
  EXPECT_EQ(rows("# t, F\n1.5 -2\n2.5 3000\n", kFirstTwo), kTwo);
  EXPECT_EQ(table_->columns(), (std::vector<std::string>{"t", "F"}));
  EXPECT_EQ(rows("1.5,-2\n2.5,3000\n,\n \n", kFirstTwo), kTwo);
  EXPECT_EQ(table_->columns(), (std::vector<std::string>{"", ""}));
}

TEST_F(MeasuredTableTest, RowsMayLackTheLastColumnsThatAreNotRead) { // LabVIEW's comment
  EXPECT_EQ(rows("***End_of_Header***\n\nX_Value\tForce\tComment\n1.5\t-2\n2.5\t3e3\n", kFirstTwo), kTwo);
  EXPECT_TRUE(problems_.empty());
  EXPECT_TRUE(rows("a,b,c\n1,2\n3,4\n", {{0}, {2}}).empty());
}

TEST_F(MeasuredTableTest, ABadRowBelowTheNamesIsNamedAndALineOfThePreambleIsNot) {
  EXPECT_EQ(rows("a,b\n7\n1.5,-2\n2.5,3e3\n1,2\n3,4\n", kFirstTwo).size(), 4u);
  EXPECT_EQ(problems_.size(), 1u);
  EXPECT_EQ(rows("Logger;A\nDate;2021\nt;F\n1,5;-2\n2,5;3e3\n", kFirstTwo), kTwo);
  EXPECT_EQ(table_->columns().front(), "t");
  EXPECT_TRUE(problems_.empty());
}

TEST_F(MeasuredTableTest, ReadsEveryEncoding) {
  EXPECT_EQ(rows("\xEF\xBB\xBF"
                 "a,b\n1.5,-2\n2.5,3e3\n",
                 kFirstTwo),
            kTwo);
  EXPECT_EQ(table_->columns().front(), "a");
  for (const bool mark : {true, false})
    for (const bool little : {true, false}) {
      std::string wide = !mark ? "" : little ? "\xFF\xFE" : "\xFE\xFF";
      for (const char letter : std::string("a,b\n1.5,-2\n2.5,3e3\n"))
        wide += little ? std::string{letter, '\0'} : std::string{'\0', letter};
      EXPECT_EQ(rows(wide, kFirstTwo), kTwo) << mark << little;
    }
  rows("Temperatur \xB0"
       "C,b\n1,2\n",
       kFirstTwo);
  EXPECT_EQ(table_->columns().front(), "Temperatur \xC2\xB0"
                                       "C");
}

TEST_F(MeasuredTableTest, NamesEachBadValueAndContinues) {
  EXPECT_EQ(rows("a,b\n1.5,-2\n1,NaN\nx,\n1\n1,2,3\n2.5,3e3\n7", kFirstTwo), kTwo);
  ASSERT_EQ(problems_.size(), 5u);
  EXPECT_EQ(problems_[0], "column b: got \"NaN\", expected a finite number");
  EXPECT_EQ(problems_[2], "1 fields; expected, by the names of the columns, 2");
  EXPECT_EQ(problems_.back(), "the file ends in the middle of this line");
  EXPECT_EQ(rows("1.5 -2 start now\n2.5 3e3\n", kFirstTwo), kTwo) << "words after the rows of a table without names";
}

TEST_F(MeasuredTableTest, ReadsDatesAndTimes) {
  using As = ChosenColumn::As;
  EXPECT_EQ(rows("t,a\n2017-07-31T16:14:36+02:00,1\n2017-07-31 14:14:38.5Z,2\n", {{0, As::Clock}, {1}}),
            (Table{{1501510476, 1}, {1501510478.5, 2}}));
  EXPECT_TRUE(table_->isDate(0));
  EXPECT_EQ(rows("t;a\n01:00:00,25;1\n01:00:01,75;2\n", {{0, As::Clock}, {1}}), (Table{{3600.25, 1}, {3601.75, 2}}));
  EXPECT_TRUE(rows("t,a\n03/05/2021 00:00,1\n", {{0, As::Clock}}).empty());
  EXPECT_NE(problems_.front().find("day first"), std::string::npos);
  TableForm form;
  form.dates = DateOrder::MonthFirst;
  EXPECT_EQ(rows("t,a\n03/05/2021 00:00,1\n", {{0, As::Clock}}, form), (Table{{1614902400}}));
  EXPECT_EQ(rows("run,a\nA,1\nB,2\nA,3\n", {{0, As::Label}, {1}}), (Table{{0, 1}, {1, 2}, {0, 3}}));
}

TEST_F(MeasuredTableTest, NamesOtherFilesForWhatTheyAre) {
  const auto refusal = [this](const std::string& content) {
    try {
      openTable(file("other", content), {});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal("\x1f\x8b...").find("gunzip"), std::string::npos);
  EXPECT_NE(refusal("PK\x03\x04" + std::string(26, '\0') + "[Content_Types].xml").find("Excel"), std::string::npos);
  EXPECT_NE(refusal("").find("empty"), std::string::npos);
  EXPECT_NE(refusal("words alone\nand more\n").find("no rows of numbers"), std::string::npos);
}

TEST_F(MeasuredTableTest, AWizardFreeTableNeedsNoMap) {
  std::string text = "time_ms,Fx [mN],Fy [mN],Fz [mN],R0_0,R0_1,R1_0,R1_1\n";
  for (int i = 0; i < 20; ++i)
    text += std::to_string(10 * i) + ",1,2," + std::to_string(-100 - i) + ",1,2,3," + std::to_string(4 + i) + "\n";
  const std::filesystem::path table = file("rig.csv", text), output = folder_.path() / "samples.csv";
  const Imported imported = importSamples({{table}, {}, nullptr, output}, {}, {});
  EXPECT_EQ(imported.samples, 20u);
  const SampleSet set = loadSamples(output);
  EXPECT_EQ(set.rowWires, 2);
  EXPECT_EQ(set.columnWires, 2);
  EXPECT_DOUBLE_EQ(set.times_s(0, 19), 0.19);
  EXPECT_DOUBLE_EQ(set.forces_N(2, 19), -0.119);
  EXPECT_DOUBLE_EQ(set.resistances_ohm(3, 19), 23);
  // The map that was used gives the same samples.
  const std::filesystem::path map = file("map.json", guessImportMap({table}).json);
  importSamples({{table}, map, nullptr, folder_.path() / "again.csv"}, {}, {});
  EXPECT_EQ(readFile(output), readFile(folder_.path() / "again.csv"));
}

TEST_F(MeasuredTableTest, ForcesOfAnotherClockAreInterpolated) {
  std::string readings, forces;
  for (int i = 0; i < 40; ++i) readings += std::to_string(5 - i % 3) + " " + std::to_string(0.1 * i + 0.03) + "\n";
  for (int i = 5; i < 30; ++i) forces += std::to_string(-2.0 * i) + " " + std::to_string(0.1 * i) + "\n";
  const auto map =
      file("map.json", R"({"palp_import": 1, "signals": {"columns": [1]}, "time": {"column": 2, "unit": "s"},
    "forces": {"columns": [null, null, 1], "unit": "N", "table": 2, "time": {"column": 2, "unit": "s"}}})");
  const auto output = folder_.path() / "samples.csv";
  const Imported imported =
      importSamples({{file("r.txt", readings), file("f.txt", forces)}, map, nullptr, output}, {}, {});
  EXPECT_EQ(imported.samples + imported.leftOut, 40u);
  const SampleSet set = loadSamples(output);
  for (Eigen::Index i = 0; i < set.size(); ++i) EXPECT_NEAR(set.forces_N(2, i), -20 * set.times_s(0, i), 1e-4);
  EXPECT_TRUE(set.origin.ofSignals);
}

TEST_F(MeasuredTableTest, SeveralTablesOfOneFormAreRuns) {
  const auto table = [this](const std::string& name, double force) {
    return file(name, "ch1,ch2,Fz,t\n1,2," + std::to_string(force) + ",0\n2,1,-1,1\n");
  };
  const auto output = folder_.path() / "samples.h5";
  const Imported imported = importSamples({{table("a.csv", -1), table("b.csv", -2)}, {}, nullptr, output}, {}, {});
  EXPECT_EQ(imported.runs, 2u);
  const SampleSet set = loadSamples(output);
  EXPECT_EQ(set.runs, (Eigen::RowVector4d(0, 0, 1, 1)));
  EXPECT_EQ(set.times_s, (Eigen::RowVector4d(0, 1, 0, 1)));
}

TEST_F(MeasuredTableTest, BadRowsAreCountedAndLeftOutOnRequest) {
  std::string text = "ch1,Fz\n";
  for (int i = 0; i < 30; ++i) text += (i % 2 == 0 ? "1," : "dead,") + std::to_string(-i) + "\n";
  const auto table = file("bad.csv", text), output = folder_.path() / "samples.csv";
  try {
    importSamples({{table}, {}, nullptr, output}, {}, {});
    FAIL();
  } catch (const Error& error) {
    const std::string words = error.what();
    EXPECT_NE(words.find("15 rows cannot be used"), std::string::npos) << words;
    EXPECT_NE(words.find("line 3: column ch1: got \"dead\""), std::string::npos) << words;
    EXPECT_EQ(words.find("line 25"), std::string::npos) << "ten are shown";
  }
  EXPECT_FALSE(std::filesystem::exists(output));
  const Imported imported = importSamples({{table}, {}, nullptr, output, false, true}, {}, {});
  EXPECT_EQ(imported.samples, 15u);
  EXPECT_EQ(imported.leftOut, 15u);
}

TEST(Units, LoggersSpellingsAreKnown) {
  EXPECT_EQ(knownUnit("[k\u03A9]")->factor, 1e3);
  EXPECT_EQ(knownUnit("(msec)")->factor, 1e-3);
  EXPECT_EQ(unitInName("Fx (mN)")->factor, 1e-3);
  EXPECT_EQ(unitInName("x_mm")->quantity, Quantity::Length);
  EXPECT_FALSE(unitInName("R0_3"));
  EXPECT_FALSE(knownUnit("parsec"));
}

} // namespace

} // namespace palp
