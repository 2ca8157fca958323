#include "tests/app/cli/Process.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace palp::test {
namespace {

/// Rows of a part of the report, as lines.
std::vector<std::string> rows(const std::string& csv, const std::string& part) {
  std::istringstream lines(csv);
  std::vector<std::string> found;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(part + ",")) found.push_back(line);
  return found;
}

/// The last column of a row says what is wrong; a program without VTK says so of the pictures, and of nothing else.
bool good(const std::string& row) {
  const bool picture = row.find(".vtu") != std::string::npos || row.find(".png") != std::string::npos;
  if (PALP_PICTURES == 0 && picture) return row.find("needs VTK") != std::string::npos;
  return row.ends_with(",");
}

} // namespace

TEST(ReportScenes, MeasuresEveryCommandAndTheWindowAndFindsNothingThatIsNotShown) {
  const TemporaryFolder folder;
  const Outcome outcome =
      palp({"report", "scenes", "--mapped", "4x4x2", "--per-area", "6", "-o", (folder / "out").string(), "--json"});
  ASSERT_EQ(outcome.exit, 0) << outcome.errors;
  const std::string csv = readAll(folder / "out" / "points.csv");
  EXPECT_TRUE(std::ranges::all_of(rows(csv, "chain"), good));
  const auto commands = rows(csv, "command");
  for (const std::string& row : commands) EXPECT_TRUE(good(row)) << row;
  for (const char* name : {"design", "mesh", "solve", "render", "sample", "merge", "train", "predict", "sweep",
                           "calibrate", "listen", "reproduce"})
    EXPECT_TRUE(std::ranges::any_of(commands, [&](const std::string& row) {
      return row.find("palp " + std::string(name)) != std::string::npos;
    })) << name;
  const auto window = rows(csv, "window");
  const bool built = std::filesystem::exists(std::filesystem::path(PALP_BINARY).parent_path() / "palp-studio");
  EXPECT_EQ(window.size(), built ? 66U : 1U); // 6 scenes twice in turn, 9 steps in each
  for (const std::string& row : window) EXPECT_TRUE(good(row)) << row;
}

} // namespace palp::test
