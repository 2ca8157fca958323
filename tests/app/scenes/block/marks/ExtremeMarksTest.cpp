#include "app/scenes/block/marks/ExtremeMarks.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

struct Case {
  Eigen::Matrix3Xd places_mm = Eigen::Matrix3Xd::Zero(3, 4);
  std::vector<double> values{-3, 1, 2.5, 0};
  DeformationOptions options;

  Case() {
    places_mm.row(1) << 2, 20, 10, 18;
    options.extremes = true;
    options.quantity = Quantity::StressZZ;
  }
  [[nodiscard]] std::vector<PlacedText> marks() const { return extremeMarks(values, places_mm, options); }
};

TEST(ExtremeMarks, StandAtTheLargestAndTheSmallestOfTheWholeBlock) {
  const std::vector<PlacedText> marks = Case().marks();
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].text, "largest 2.5 MPa");
  EXPECT_EQ(marks[0].place_mm.y(), 10);
  EXPECT_EQ(marks[1].text, "smallest -3 MPa");
  EXPECT_EQ(marks[1].place_mm.y(), 2);
}

TEST(ExtremeMarks, AreThoseOfWhatTheCutLeaves) {
  Case cut;
  cut.options.cut = CutPlane{1, 15};
  const std::vector<PlacedText> marks = cut.marks();
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].text, "largest shown 1 MPa");
  EXPECT_EQ(marks[0].place_mm.y(), 20);
  EXPECT_EQ(marks[1].text, "smallest shown 0 MPa");
  EXPECT_EQ(marks[1].place_mm.y(), 18);
  cut.options.cut = CutPlane{1, 25};
  EXPECT_TRUE(cut.marks().empty()) << "nothing stays";
}

TEST(ExtremeMarks, StandNowhereWhereAllValuesAreAlikeAsAtRest) {
  Case rest;
  rest.values.assign(4, 0);
  EXPECT_TRUE(rest.marks().empty());
  rest.values[2] = 1e-9;
  EXPECT_EQ(rest.marks().size(), 2u);
}

} // namespace
} // namespace palp
