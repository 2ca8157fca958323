#include "app/study/material/LawFit.h"

#include "app/study/material/LeastSquares.h"
#include "model/base/Error.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace palp;

namespace {

/// L. R. G. Treloar, Trans. Faraday Soc. 40 (1944): vulcanised rubber with 8 % of sulphur at 20 C, as digitised by
/// P. Steinmann, M. Hossain and G. Possart, Arch. Appl. Mech. 82 (2012): stretch, nominal stress [MPa].
constexpr double kUniaxial[][2] = {{1, 0},       {1.01, 0.03}, {1.12, 0.14}, {1.24, 0.23}, {1.39, 0.32},
                                   {1.61, 0.41}, {1.89, 0.5},  {2.17, 0.58}, {2.42, 0.67}, {3.01, 0.85},
                                   {3.58, 1.04}, {4.03, 1.21}, {4.76, 1.58}, {5.36, 1.94}, {5.76, 2.29},
                                   {6.16, 2.67}, {6.4, 3.02},  {6.62, 3.39}, {6.87, 3.75}, {7.05, 4.12},
                                   {7.16, 4.47}, {7.27, 4.85}, {7.43, 5.21}, {7.5, 5.57},  {7.61, 6.3}};
constexpr double kPlanar[][2] = {{1, 0},       {1.06, 0.07}, {1.14, 0.16}, {1.21, 0.24}, {1.32, 0.33},
                                 {1.46, 0.42}, {1.87, 0.59}, {2.4, 0.76},  {2.98, 0.93}, {3.48, 1.11},
                                 {3.96, 1.28}, {4.36, 1.46}, {4.69, 1.62}, {4.96, 1.79}};
constexpr double kEquibiaxial[][2] = {{1, 0},       {1.04, 0.09}, {1.08, 0.16}, {1.12, 0.24}, {1.14, 0.26},
                                      {1.2, 0.33},  {1.31, 0.44}, {1.42, 0.51}, {1.69, 0.65}, {1.94, 0.77},
                                      {2.49, 0.96}, {3.03, 1.24}, {3.43, 1.45}, {3.75, 1.72}, {4.03, 1.96},
                                      {4.26, 2.22}, {4.44, 2.43}};

template <std::size_t N> void addTreloar(std::vector<TestRow>& rows, TestMode mode, const double (&data)[N][2]) {
  for (const auto& [stretch, stress] : data) rows.push_back({mode, stretch, stress});
}

std::vector<TestRow> treloar(std::vector<TestMode> modes) {
  std::vector<TestRow> rows;
  for (const TestMode mode : modes) {
    if (mode == TestMode::Uniaxial) addTreloar(rows, mode, kUniaxial);
    if (mode == TestMode::Planar) addTreloar(rows, mode, kPlanar);
    if (mode == TestMode::Equibiaxial) addTreloar(rows, mode, kEquibiaxial);
  }
  return rows;
}

const std::vector<TestMode> kAll{TestMode::Uniaxial, TestMode::Planar, TestMode::Equibiaxial};

/// Least-squares answers calculated apart from this program, to their printed digits.
struct PrintedFit {
  std::vector<TestMode> modes;
  RubberLawKind kind;
  std::vector<double> values;
};

TEST(LawFit, OfLinearLawsReachesThePrintedConstants) {
  using enum RubberLawKind;
  const std::vector<PrintedFit> all{{{TestMode::Uniaxial}, NeoHooke, {0.28358}},
                                    {{TestMode::Uniaxial}, MooneyRivlin, {0.406382, -0.747749}},
                                    {{TestMode::Uniaxial}, Yeoh, {0.175535, -0.00187853, 4.63224e-5}},
                                    {{TestMode::Planar}, NeoHooke, {0.169657}},
                                    {{TestMode::Planar}, Yeoh, {0.176489, -0.00154838, 4.87875e-5}},
                                    {{TestMode::Equibiaxial}, NeoHooke, {0.236438}},
                                    {{TestMode::Equibiaxial}, MooneyRivlin, {0.171344, 0.00468487}},
                                    {{TestMode::Equibiaxial}, Yeoh, {0.205038, -0.000750952, 3.13897e-5}},
                                    {kAll, NeoHooke, {0.262443}},
                                    {kAll, MooneyRivlin, {0.26583, -0.00169591}},
                                    {kAll, Yeoh, {0.183027, -0.00141845, 3.93471e-5}}};
  for (const PrintedFit& printed : all) {
    const LawComparison found = fitLaws(treloar(printed.modes), {{printed.kind, 0}}, Residuals::Absolute);
    ASSERT_EQ(found.fits.size(), 1U);
    for (std::size_t k = 0; k < printed.values.size(); ++k)
      EXPECT_NEAR(found.fits[0].values(static_cast<Eigen::Index>(k)), printed.values[k],
                  6e-6 * std::abs(printed.values[k]))
          << found.fits[0].candidate.name() << " of " << printed.modes.size() << " modes";
  }
}

TEST(LawFit, OfOgdensLawReachesThePrintedResidual) {
  const LawComparison found = fitLaws(treloar(kAll), {{RubberLawKind::Ogden, 3}}, Residuals::Absolute);
  ASSERT_EQ(found.fits.size(), 1U);
  EXPECT_LE(found.fits[0].rms_MPa, 0.0612 + 5e-5); // as printed; the constants of several optima differ
}

TEST(LawFit, FindsTheConstantsThatMadeTheRows) {
  const std::vector<std::pair<LawCandidate, RubberLaw>> laws{
      {{RubberLawKind::MooneyRivlin, 0}, MooneyRivlin{0.15, 0.05}},
      {{RubberLawKind::Yeoh, 0}, Yeoh{0.2, -0.01, 0.003}},
      {{RubberLawKind::Gent, 0}, Gent{0.3, 20}},
      {{RubberLawKind::Ogden, 1}, Ogden{{0.3}, {3.7}}},
      {{RubberLawKind::Ogden, 2}, Ogden{{0.3, 0.02}, {1.3, 6.5}}}};
  for (const auto& [candidate, law] : laws) {
    std::vector<TestRow> rows;
    for (const auto& [mode, name] : kTestModes.all())
      for (int k = 0; k < 15; ++k) rows.push_back({mode, 0.6 + 0.1 * k, nominalStress_MPa(law, mode, 0.6 + 0.1 * k)});
    const LawComparison found = fitLaws(rows, {candidate}, Residuals::Relative);
    ASSERT_EQ(found.fits.size(), 1U) << candidate.name();
    EXPECT_LT(found.fits[0].rms, 1e-6) << candidate.name();
    EXPECT_LT(found.fits[0].heldOut.value_or(1), 1e-5) << candidate.name();
    EXPECT_TRUE(found.warnings.empty());
  }
}

TEST(LawFit, OfManyRowsIsThatOfFew) {
  const Ogden law{{0.3, -0.05}, {1.7, -3}};
  std::vector<TestRow> rows;
  for (int k = 0; k <= 2000; ++k) {
    const double stretch = 0.6 + 0.001 * k;
    rows.push_back({TestMode::Uniaxial, stretch, nominalStress_MPa(law, TestMode::Uniaxial, stretch)});
  }
  const LawComparison found = fitLaws(rows, {{RubberLawKind::Ogden, 2}}, Residuals::Absolute);
  ASSERT_EQ(found.fits.size(), 1U);
  EXPECT_LT(found.fits[0].rms_MPa, 1e-6);
}

TEST(LawFit, HasTheDeviationsOfTheConstantsUnderNoise) {
  // y = 2 c (l - l^-2) + noise: var c = s^2 / sum x^2, s^2 of the residuals.
  std::vector<TestRow> rows;
  double xx = 0, xy = 0;
  for (int k = 0; k < 20; ++k) {
    const double l = 0.7 + 0.05 * k, x = 2 * (l - 1 / (l * l)), y = 0.2 * x + 0.01 * std::sin(40. * k);
    rows.push_back({TestMode::Uniaxial, l, y});
    xx += x * x;
    xy += x * y;
  }
  double squares = 0;
  for (const TestRow& row : rows) {
    const double x = 2 * (row.stretch - 1 / (row.stretch * row.stretch));
    squares += std::pow(row.stress_MPa - xy / xx * x, 2);
  }
  const LawFit fit = fitLaws(rows, {{RubberLawKind::NeoHooke, 0}}, Residuals::Absolute).fits.at(0);
  EXPECT_NEAR(fit.values(0), xy / xx, 1e-12);
  EXPECT_NEAR(fit.covariance(0, 0), squares / 19 / xx, 1e-8 * squares / 19 / xx);
  EXPECT_NEAR(fittedDeviation_MPa(fit, TestMode::Uniaxial, 1.3), std::sqrt(squares / 19 / xx) * 2 * (1.3 - 1 / 1.69),
              1e-9);
}

TEST(LawFit, SaysWherePlanarRowsCannotSeparateTheConstants) {
  const LawComparison found =
      fitLaws(treloar({TestMode::Planar}), {{RubberLawKind::MooneyRivlin, 0}}, Residuals::Absolute);
  ASSERT_EQ(found.without.size(), 1U);
  EXPECT_NE(found.without[0].reason.find("cannot separate c10 from c01"), std::string::npos);
}

TEST(LawFit, WarnsOfTensionAloneAndOfANegativeC01) {
  const LawComparison found = fitLaws(treloar({TestMode::Uniaxial}), lawCandidates(), Residuals::Absolute);
  bool compression = false, negative = false;
  for (const std::string& warning : found.warnings) {
    compression = compression || warning.find("no compression") != std::string::npos;
    negative =
        negative || (warning.starts_with("mooney-rivlin: ") && warning.find("c01 is -0.748") != std::string::npos);
  }
  EXPECT_TRUE(compression);
  EXPECT_TRUE(negative);
  ASSERT_TRUE(found.best);
  EXPECT_TRUE(found.fits[*found.best].stableOnRows);
}

TEST(LawFit, NeedsAsManyRowsAsConstants) {
  const LawComparison found = fitLaws({{TestMode::Uniaxial, 1.2, 0.1}, {TestMode::Uniaxial, 1.4, 0.2}},
                                      {{RubberLawKind::NeoHooke, 0}, {RubberLawKind::Yeoh, 0}}, Residuals::Absolute);
  EXPECT_EQ(found.fits.size(), 1U);
  ASSERT_EQ(found.without.size(), 1U);
  EXPECT_EQ(found.without[0].reason, "got 2 rows, expected at least its 3 constants");
}

TEST(TestRows, AreReadInTheirUnits) {
  const auto rows = parseTestRows("\xef\xbb\xbf# a test\nstrain_percent;stress_kPa;mode;weight\r\n-20; -50;planar;2\r\n"
                                  "30;100;equibiaxial;1\r\n",
                                  "t.csv", TestMode::Uniaxial);
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_DOUBLE_EQ(rows[0].stretch, 0.8);
  EXPECT_DOUBLE_EQ(rows[0].stress_MPa, -0.05);
  EXPECT_EQ(rows[0].mode, TestMode::Planar);
  EXPECT_EQ(rows[0].weight, 2);
  EXPECT_EQ(rows[1].mode, TestMode::Equibiaxial);
  const auto plain = parseTestRows("stretch,stress_MPa\n1.5,0.2\n", "t.csv", TestMode::Planar);
  EXPECT_EQ(plain.at(0).mode, TestMode::Planar);
}

TEST(TestRows, AreRefusedWithPlaceValueAndExpectation) {
  const auto refusal = [](const std::string& csv) -> std::string {
    try {
      (void)parseTestRows(csv, "t.csv", TestMode::Uniaxial);
    } catch (const Error& error) {
      return error.what();
    }
    return "read";
  };
  EXPECT_EQ(refusal("stretch,stress_MPa\n1.5,x\n"), "t.csv, line 2: stress_MPa: got 'x', expected a number");
  EXPECT_EQ(refusal("stretch,stress_MPa\n1.5\n"), "t.csv, line 2: got 1 fields, expected 2, as the header has");
  EXPECT_EQ(refusal("stretch,stress_MPa\n0,1\n"),
            "t.csv, line 2: stretch: got 0, expected 0.01 to 100 (1 at rest; a strain counts from 0)");
  EXPECT_EQ(refusal("strain,stress_MPa,mode\n0,1,shear\n"),
            "t.csv, line 2: mode: got 'shear', expected uniaxial, equibiaxial or planar");
  EXPECT_EQ(refusal("strain,stress_MPa,weight\n0,1,-1\n"), "t.csv, line 2: weight: got -1, expected 0 or more");
  EXPECT_NE(refusal("strain,force\n").find("line 1: unknown column: got 'force', expected one of stretch"),
            std::string::npos);
  EXPECT_NE(refusal("strain,stretch,stress_MPa\n").find("a second column of this kind: got 'stretch'"),
            std::string::npos);
  EXPECT_NE(refusal("strain\n0\n").find("a column is missing"), std::string::npos);
  EXPECT_NE(refusal("").find("no rows of a test"), std::string::npos);
}

} // namespace
