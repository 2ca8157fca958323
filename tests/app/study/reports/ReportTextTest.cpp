#include "app/study/reports/ReportText.h"

#include "app/study/Resources.h"
#include "model/base/Error.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <stdexcept>

namespace palp {

TEST(ReportText, OfEveryReportCanBeFilledIn) {
  int texts = 0;
  for (const auto& entry : std::filesystem::directory_iterator(resource("reports"))) {
    SCOPED_TRACE(entry.path());
    ASSERT_EQ(entry.path().extension(), ".md");
    const ReportText words(entry.path().stem().string());
    for (const std::string& key : words.keys()) {
      ReportText::Values values;
      for (const std::string& name : words.names(key)) values[name] = "12.5";
      const std::string filled = words(key, values);
      EXPECT_EQ(filled.find_first_of("{}"), std::string::npos) << filled;
      EXPECT_FALSE(filled.empty()) << key;
      ++texts;
    }
  }
  EXPECT_GT(texts, 10);
}

TEST(ReportText, HasTablesAndChartsWithTheirUnits) {
  const ReportText words("readout");
  const ReportTable table = words.table("sweep table", {{"noise", 1e-4}, {"what", "radius [mm]"}});
  EXPECT_EQ(table.caption, "All row-wires, noise 0.0001 of each reading: bound without prior, geometric mean of the "
                           "forces [% of range]");
  EXPECT_EQ(table.heads, std::vector<std::string>{"radius [mm]"});
  const ReportChart chart = words.chart("r", "sweep chart", {{"heading", "Radius"}, {"label", "radius [mm]"}});
  EXPECT_EQ(chart.caption, "Bound without prior of all row-wires against the radius [mm]");
  EXPECT_EQ(chart.title, "Radius");
  EXPECT_EQ(chart.xLabel, "radius [mm]");
  EXPECT_EQ(chart.yLabel, "bound, geometric mean [% of range]");
  EXPECT_THROW(static_cast<void>(words.chart("r", "sweep table", {{"noise", 1}, {"what", 2}})), std::logic_error);
}

TEST(ReportText, RefusesMissingAndUnusedNamesAndUnknownKeys) {
  const ReportText words("readout");
  EXPECT_EQ(words("law pairs"),
            "The design's law is Eq. (1), which has no read-out; here its block has the default field law");
  EXPECT_THROW(static_cast<void>(words("sweep table", {{"noise", 1e-4}})), std::logic_error);
  EXPECT_THROW(static_cast<void>(words("law pairs", {{"unit", "mm"}})), std::logic_error);
  EXPECT_THROW(static_cast<void>(words("no such key")), std::logic_error);
  EXPECT_THROW(ReportText("no such report"), Error);
}

} // namespace palp
