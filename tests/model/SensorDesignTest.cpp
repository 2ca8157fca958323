#include "model/SensorDesign.h"
#include "model/DesignError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace palp {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(SensorDesign, PaperPresetCanBeBuiltAndIsSquare) {
  const SensorDesign design = paperDesign();
  EXPECT_TRUE(check(design).empty());
  EXPECT_FALSE(whyNotSquare(design));
  EXPECT_NO_THROW(requireValid(design));
}

TEST(SensorDesign, PaperPresetHasThePapersLayout) {
  const SensorDesign design = paperDesign();
  EXPECT_EQ(design.rowWires(), 10);
  EXPECT_EQ(design.electrodesPerRowWire(), 10);
  EXPECT_EQ(design.columnWires(), 30);
  EXPECT_EQ(design.electrodesPerColumnWire(), 3);
  EXPECT_EQ(design.upperElectrodes_mm().col(4 * 10 + 2), Eigen::Vector3d(7.5, 13.5, 4));
  EXPECT_EQ(design.lowerElectrodes_mm().col(29 * 3 + 1), Eigen::Vector3d(29.5, 15, 1));
}

TEST(SensorDesign, AreasRunAlongXFirst) {
  const SensorDesign design = paperDesign();
  ASSERT_EQ(design.areas.count(), 6);
  const Rectangle area = design.areaRectangle(4); // column 1, row 1
  EXPECT_EQ(area.low_mm, Eigen::Vector2d(10, 15));
  EXPECT_EQ(area.high_mm, Eigen::Vector2d(20, 30));
}

TEST(SensorDesign, ListsAWireMayDiffer) {
  SensorDesign design = paperDesign();
  design.lower.along_mm.assign(30, {5, 15, 25});
  design.lower.along_mm[3] = {6, 16, 26};
  design.lower.z_mm.assign(30, {1, 1, 2});
  EXPECT_TRUE(check(design).empty());
  EXPECT_EQ(design.lowerElectrodes_mm().col(3 * 3 + 2), Eigen::Vector3d(3.5, 26, 2));
}

TEST(SensorDesign, LowerElectrodesMayLieOnTheBottom) {
  SensorDesign design = paperDesign();
  design.lower.z_mm = {{0}};
  EXPECT_TRUE(check(design).empty());
}

TEST(SensorDesign, IncompressibleRubberIsAllowed) {
  SensorDesign design = paperDesign();
  design.material.poissonRatio = 0.5;
  EXPECT_TRUE(check(design).empty());
}

MooneyRivlin& mooneyRivlin(SensorDesign& design) {
  return std::get<MooneyRivlin>(design.material.law);
}

/// A design with another law, for slips in its constants.
std::function<void(SensorDesign&)> lawOf(RubberLaw law) {
  return [law = std::move(law)](SensorDesign& design) { design.material.law = law; };
}

struct Slip {
  const char* name;
  std::function<void(SensorDesign&)> make;
  const char* key;
  const char* value; ///< must stand in the sentence
};

void PrintTo(const Slip& slip, std::ostream* out) {
  *out << slip.name;
}

class DesignSlip : public testing::TestWithParam<Slip> {};

TEST_P(DesignSlip, IsOneProblemThatNamesKeyAndValue) {
  SensorDesign design = paperDesign();
  GetParam().make(design);
  const std::vector<DesignFault> problems = check(design);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].key, GetParam().key);
  EXPECT_NE(problems[0].sentence.find(GetParam().value), std::string::npos) << problems[0].sentence;
  EXPECT_THROW(requireValid(design), DesignError);
}

INSTANTIATE_TEST_SUITE_P(
    Each, DesignSlip,
    testing::Values(
        Slip{"DensityNegative", [](SensorDesign& d) { d.material.density_t_per_mm3 = -1; },
             "material.density_t_per_mm3", "-1"},
        Slip{"C10Zero", [](SensorDesign& d) { mooneyRivlin(d).c10_MPa = 0; }, "material.c10_MPa", "0 MPa"},
        Slip{"C10Nan", [](SensorDesign& d) { mooneyRivlin(d).c10_MPa = kNan; }, "material.c10_MPa", "nan"},
        Slip{"C10Infinite", [](SensorDesign& d) { mooneyRivlin(d).c10_MPa = kInfinity; }, "material.c10_MPa", "inf"},
        Slip{"C01Nan", [](SensorDesign& d) { mooneyRivlin(d).c01_MPa = kNan; }, "material.c01_MPa", "nan"},
        Slip{"NeoHookeZero", lawOf(NeoHooke{0}), "material.c10_MPa", "got 0 MPa, expected above 0"},
        Slip{"YeohC10Negative", lawOf(Yeoh{-0.1, 0, 0}), "material.c10_MPa", "-0.1 MPa"},
        Slip{"YeohC20Nan", lawOf(Yeoh{0.1, kNan, 0}), "material.c20_MPa", "nan"},
        Slip{"YeohC30Infinite", lawOf(Yeoh{0.1, 0, kInfinity}), "material.c30_MPa", "inf"},
        Slip{"GentMuZero", lawOf(Gent{0, 30}), "material.mu_MPa", "0 MPa"},
        Slip{"GentJmZero", lawOf(Gent{0.1, 0}), "material.jm", "got 0, expected above 0"},
        Slip{"OgdenEmpty", lawOf(Ogden{{}, {}}), "material.mu_MPa", "0 terms, expected 1 to 3"},
        Slip{"OgdenFourTerms", lawOf(Ogden{{1, 1, 1, 1}, {1, 2, 3, 4}}), "material.mu_MPa", "4 terms"},
        Slip{"OgdenUnequal", lawOf(Ogden{{0.1, 0.2}, {2}}), "material.alpha", "1 exponents, expected as many"},
        Slip{"OgdenAlphaZero", lawOf(Ogden{{0.1, 0.2}, {2, 0}}), "material.alpha[1]", "got 0, expected 0.01"},
        Slip{"OgdenMuNan", lawOf(Ogden{{kNan, 0.2}, {2, 4}}), "material.mu_MPa[0]", "nan"},
        Slip{"OgdenNoStiffness", lawOf(Ogden{{0.1, -0.2}, {2, 4}}), "material.mu_MPa", "a sum of -0.1 MPa"},
        Slip{"NoStiffness", [](SensorDesign& d) { mooneyRivlin(d).c01_MPa = -0.3286; }, "material.c01_MPa", "-0.3286"},
        Slip{"PoissonRatioAboveOneHalf", [](SensorDesign& d) { d.material.poissonRatio = 0.50001; },
             "material.poisson_ratio", "0.50001"},
        Slip{"PoissonRatioNegative", [](SensorDesign& d) { d.material.poissonRatio = -0.1; }, "material.poisson_ratio",
             "-0.1"},
        Slip{"PoissonRatioNan", [](SensorDesign& d) { d.material.poissonRatio = kNan; }, "material.poisson_ratio",
             "nan"},
        Slip{"NoAreaColumn", [](SensorDesign& d) { d.areas.columns = 0; }, "areas.columns", "0"},
        Slip{"TooManyAreaRows", [](SensorDesign& d) { d.areas.rows = 51; }, "areas.rows", "51"},
        Slip{"NoRowWire", [](SensorDesign& d) { d.upper.wire_mm.clear(); }, "upper_layer.row_wire_y_mm", "0 wires"},
        Slip{"TooManyColumnWires", [](SensorDesign& d) { d.lower.wire_mm.assign(256, 3.0); },
             "lower_layer.column_wire_x_mm", "256 wires"},
        Slip{"WrongNumberOfLists",
             [](SensorDesign& d) {
               d.lower.along_mm.assign(29, {5, 15, 25});
             },
             "lower_layer.electrode_y_mm", "29 lists"},
        Slip{"NoElectrode", [](SensorDesign& d) { d.lower.along_mm = {{}}; }, "lower_layer.electrode_y_mm",
             "0 electrodes"},
        Slip{"RaggedLists",
             [](SensorDesign& d) {
               d.lower.along_mm.assign(30, {5, 15, 25});
               d.lower.along_mm[7].pop_back();
             },
             "lower_layer.electrode_y_mm", "column-wire 7"},
        Slip{"WrongDepths",
             [](SensorDesign& d) {
               d.lower.z_mm = {{1, 2}};
             },
             "lower_layer.z_mm", "one depth"},
        Slip{"NoDepth", [](SensorDesign& d) { d.upper.z_mm.clear(); }, "upper_layer.z_mm", "one depth"},
        Slip{"ElectrodeOutside", [](SensorDesign& d) { d.upper.along_mm[0][9] = 30; }, "upper_layer.electrode_x_mm",
             "x = 30"},
        Slip{"ElectrodeNan", [](SensorDesign& d) { d.upper.along_mm[0][3] = kNan; }, "upper_layer.electrode_x_mm",
             "nan"},
        Slip{"RowWireOutside", [](SensorDesign& d) { d.upper.wire_mm[2] = -1; }, "upper_layer.row_wire_y_mm", "y = -1"},
        Slip{"UpperLayerAboveTheBlock", [](SensorDesign& d) { d.upper.z_mm = {{5}}; }, "upper_layer.z_mm", "z = 5"},
        Slip{"ColumnWireOutside", [](SensorDesign& d) { d.lower.wire_mm[0] = 31; }, "lower_layer.column_wire_x_mm",
             "x = 31"},
        Slip{"ColumnElectrodeOutside", [](SensorDesign& d) { d.lower.along_mm[0][2] = 40; },
             "lower_layer.electrode_y_mm", "y = 40"},
        Slip{"LowerLayerBelowTheBlock", [](SensorDesign& d) { d.lower.z_mm = {{-0.1}}; }, "lower_layer.z_mm",
             "z = -0.1"},
        Slip{"SameElectrodeTwice", [](SensorDesign& d) { d.upper.along_mm[0][5] = 1.5; }, "upper_layer.electrode_x_mm",
             "electrode 5 of row-wire 0"},
        Slip{"SameWireTwice", [](SensorDesign& d) { d.lower.wire_mm[8] = 0.5; }, "lower_layer.column_wire_x_mm",
             "column-wire 8"},
        Slip{"LayersCross", [](SensorDesign& d) { d.lower.z_mm = {{4}}; }, "lower_layer.z_mm", "z = 4"},
        Slip{"RateZero", [](SensorDesign& d) { d.resistance = PairsLaw{0}; }, "resistance.rate_ohm_per_mm", "0 ohm/mm"},
        Slip{"RateInfinite", [](SensorDesign& d) { d.resistance = PairsLaw{kInfinity}; }, "resistance.rate_ohm_per_mm",
             "inf"},
        Slip{"ResistivityZero", [](SensorDesign& d) { d.resistance = FieldLaw{.resistivity_ohm_mm = 0}; },
             "resistance.resistivity_ohm_mm", "0 ohm mm"},
        Slip{"RadiusZero", [](SensorDesign& d) { d.resistance = FieldLaw{.electrodeRadius_mm = 0}; },
             "resistance.electrode_radius_mm", "0 mm"},
        Slip{"ResistivityLost", [](SensorDesign& d) { d.resistance = FieldLaw{.resistivity_ohm_mm = 1e-300}; },
             "resistance.resistivity_ohm_mm", "got 1e-300 ohm mm, expected 1e-06 to"},
        Slip{"RadiusLost", [](SensorDesign& d) { d.resistance = FieldLaw{.electrodeRadius_mm = 1e-170}; },
             "resistance.electrode_radius_mm", "got 1e-170 mm, expected 1e-06 to"},
        Slip{"PressureLost",
             [](SensorDesign& d) {
               d.pressureLaw = PressureLaw{1e-300, 2};
             },
             "resistance.pressure_law.p0_MPa", "got 1e-300 MPa, expected 1e-06 to"},
        Slip{"RadiusNan", [](SensorDesign& d) { d.resistance = FieldLaw{.electrodeRadius_mm = kNan}; },
             "resistance.electrode_radius_mm", "nan"},
        Slip{"ContactNegative", [](SensorDesign& d) { d.resistance = FieldLaw{.contact_ohm_mm2 = -1}; },
             "resistance.contact_ohm_mm2", "-1 ohm mm2"},
        Slip{"WireInfinite", [](SensorDesign& d) { d.resistance = FieldLaw{.wire_ohm = kInfinity}; },
             "resistance.wire_ohm", "inf"},
        Slip{"ElectrodesOverlap", [](SensorDesign& d) { d.resistance = FieldLaw{.electrodeRadius_mm = 0.5}; },
             "resistance.electrode_radius_mm",
             "electrodes overlap (electrode 0 of column-wire 0, 0.5 mm from a face of the block): got 0.5 mm, expected "
             "below 0.5 mm"},
        Slip{"ElectrodesOverlapEachOther",
             [](SensorDesign& d) {
               d.resistance = FieldLaw{.electrodeRadius_mm = 0.4};
               d.upper.along_mm[0][3] = 12.75;
             },
             "resistance.electrode_radius_mm",
             "electrode 3 of row-wire 0 and electrode 4 of row-wire 0, 0.75 mm apart): got 0.4 mm, expected below "
             "0.375 mm"},
        Slip{"ElectrodeOnTheBottom",
             [](SensorDesign& d) {
               d.resistance = FieldLaw{};
               d.lower.z_mm = {{0}};
             },
             "resistance.electrode_radius_mm", "0 mm from a face"},
        Slip{"TooManyElectrodes",
             [](SensorDesign& d) {
               d.resistance = FieldLaw{.electrodeRadius_mm = 1e-3};
               d.upper.along_mm[0].clear();
               for (int i = 0; i < 200; ++i) d.upper.along_mm[0].push_back(0.1 + 0.149 * i);
             },
             "resistance.law", "2090 electrodes, expected up to 2000"},
        Slip{"PressureScaleZero",
             [](SensorDesign& d) {
               d.pressureLaw = PressureLaw{0, 0.5};
             },
             "resistance.pressure_law.p0_MPa", "0 MPa"},
        Slip{"PressureExponentNegative",
             [](SensorDesign& d) {
               d.pressureLaw = PressureLaw{0.05, -1};
             },
             "resistance.pressure_law.exponent", "-1"},
        Slip{"PressureExponentNan",
             [](SensorDesign& d) {
               d.pressureLaw = PressureLaw{0.05, kNan};
             },
             "resistance.pressure_law.exponent", "nan"},
        Slip{"ForceRangeEmpty", [](SensorDesign& d) { d.forceRange.high_N.z() = -6; }, "force_range_N.z", "[-6, -6]"},
        Slip{"ForceRangeReversed", [](SensorDesign& d) { d.forceRange.low_N.x() = 2; }, "force_range_N.x", "[2, 1]"},
        Slip{"ForceRangeNan", [](SensorDesign& d) { d.forceRange.low_N.y() = kNan; }, "force_range_N.y", "nan"}),
    [](const auto& each) { return each.param.name; });

TEST(SensorDesign, ABlockWithoutSizeNamesTheBlockFirst) {
  for (const double size : {0.0, -5.0, kNan, kInfinity, 1e5})
    for (int axis = 0; axis < 3; ++axis) {
      SensorDesign design = paperDesign();
      design.block_mm(axis) = size;
      const std::vector<DesignFault> problems = check(design);
      ASSERT_FALSE(problems.empty());
      EXPECT_EQ(problems[0].key, "block_mm[" + std::to_string(axis) + "]");
    }
}

TEST(SensorDesign, FindsAllProblemsInTheOrderOfTheFile) {
  SensorDesign design = paperDesign();
  design.material.poissonRatio = 2;
  design.areas.rows = 0;
  design.forceRange.low_N.x() = 7;
  const std::vector<DesignFault> problems = check(design);
  ASSERT_EQ(problems.size(), 3U);
  EXPECT_EQ(problems[0].key, "material.poisson_ratio");
  EXPECT_EQ(problems[1].key, "areas.rows");
  EXPECT_EQ(problems[2].key, "force_range_N.x");
}

/// The least distance that two electrodes must keep is 1e-6 mm, wherever they are and in whichever direction.
TEST(SensorDesign, RefusesElectrodesAtOnePlaceWhereverThatIs) {
  for (int step = 0; step < 64; ++step) { // through more than one of the cubes of 16e-6 mm in which they are looked for
    const double x = 3 + 0.7e-6 * step;
    for (const double away : {-0.9e-6, 0.9e-6, -1.1e-6, 1.1e-6}) {
      SensorDesign design = paperDesign();
      design.upper.along_mm[0][3] = x;
      design.upper.along_mm[0][1] = x + away;
      const std::vector<DesignFault> faults = check(design);
      ASSERT_EQ(faults.size(), std::abs(away) < 1e-6 ? 1U : 0U) << x << ' ' << away;
      for (const DesignFault& fault : faults) EXPECT_EQ(fault.key, "upper_layer.electrode_x_mm");
    }
  }
}

TEST(SensorDesign, NamesTheFirstTwoElectrodesAtOnePlaceOfTheLargestDesign) {
  SensorDesign design = paperDesign();
  std::vector<double> places;
  for (int i = 0; i < 255; ++i) places.push_back(0.05 + 0.117 * i);
  design.upper.wire_mm = design.lower.wire_mm = places;
  design.upper.along_mm = design.lower.along_mm = {places};
  EXPECT_TRUE(check(design).empty());
  design.upper.along_mm.assign(255, places);
  for (const int wire : {200, 101}) design.upper.along_mm[wire][9] = design.upper.along_mm[wire][5];
  const std::vector<DesignFault> faults = check(design);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].sentence,
            "duplicate electrode: got electrode 9 of row-wire 101 at the position of electrode 5 of row-wire 101, "
            "expected one electrode per position");
}

/// Where the radius is above 0.35 of a gap, with the error of small spheres with dipoles there: against bispherical
/// coordinates, as in FieldAtRestTest.
TEST(SensorDesign, WarnsOfElectrodesTooNearForSmallSpheres) {
  SensorDesign design = paperDesign();
  EXPECT_TRUE(designWarnings(design).empty());
  design.resistance = FieldLaw{.electrodeRadius_mm = 0.34}; // column-wires are 1 mm apart, and 0.5 mm from the faces
  EXPECT_TRUE(designWarnings(design).empty());
  design.lower.wire_mm.front() = 0.75; // nearer to its neighbour than to the face's mirror image
  design.resistance = FieldLaw{.electrodeRadius_mm = 0.3};
  ASSERT_TRUE(check(design).empty());
  const std::vector<std::string> said = designWarnings(design);
  ASSERT_EQ(said.size(), 1U);
  for (const char* part : {"0.3 mm is 0.4 of the gap", "electrode 0 of column-wire 0 and electrode 0 of column-wire 1",
                           "0.75 mm apart", "error is about 2.15 %"})
    EXPECT_NE(said[0].find(part), std::string::npos) << said[0];
  // As far from a neighbour as from a mirror image: two that drive each other err by more than a sphere and its image.
  design = paperDesign();
  design.resistance = FieldLaw{.electrodeRadius_mm = 0.4};
  ASSERT_EQ(designWarnings(design).size(), 1U);
  EXPECT_NE(designWarnings(design)[0].find("1 mm apart"), std::string::npos) << designWarnings(design)[0];
}

TEST(SensorDesign, WhatWorksByEq1AloneIsRefusedUnderTheField) {
  SensorDesign design = paperDesign();
  EXPECT_NO_THROW(requirePairs(design, "x"));
  design.resistance = FieldLaw{};
  ASSERT_TRUE(check(design).empty());
  try {
    requirePairs(design, "palp x");
    FAIL();
  } catch (const DesignError& refusal) {
    EXPECT_STREQ(refusal.what(),
                 "palp x: not available under the field law: got a design with resistance.law field, expected pairs");
  }
}

TEST(SensorDesign, SaysWhyEq1IsNotSquare) {
  SensorDesign design = paperDesign();
  design.lower.wire_mm.pop_back();
  EXPECT_TRUE(check(design).empty()); // allowed for learning
  const std::optional<std::string> sentence = whyNotSquare(design);
  ASSERT_TRUE(sentence);
  EXPECT_NE(sentence->find("got 29 column-wires, expected as many as a row-wire has unknowns, 3 x 10 electrodes = 30"),
            std::string::npos)
      << *sentence;
}

} // namespace
} // namespace palp
