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

TEST(ReportText, RefusesMissingAndUnusedNamesAndUnknownKeys) {
  const ReportText words("readout");
  EXPECT_EQ(words("sweep chart", {{"label", "radius"}}), "Bound without prior of all row-wires against the radius");
  EXPECT_THROW(static_cast<void>(words("sweep chart")), std::logic_error);
  EXPECT_THROW(static_cast<void>(words("sweep chart", {{"label", "a"}, {"unit", "mm"}})), std::logic_error);
  EXPECT_THROW(static_cast<void>(words("no such key")), std::logic_error);
  EXPECT_THROW(ReportText("no such report"), Error);
}

} // namespace palp
