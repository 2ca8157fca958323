#pragma once

#include "model/SampleSet.h"

#include <gtest/gtest.h>

#include <random>

namespace palp {

/// Two row-wires, two electrodes each, three column-wires, two areas.
inline SampleSet smallHead(bool together = false) {
  SampleSet set;
  set.origin = {"0123456789abcdef", 7, together ? "together" : "each", 10, "tetrahedra, 2 mm", 1e-6, false, 0, 0};
  set.rowWires = 2;
  set.electrodesPerRowWire = 2;
  set.columnWires = 3;
  set.areaCount = 2;
  set.forces_N.resize(together ? 6 : 3, 0);
  set.displacements_mm.resize(12, 0);
  set.resistances_ohm.resize(6, 0);
  return set;
}

/// Samples with the awkward numbers of random bits.
inline SampleSet randomSet(Eigen::Index size, unsigned seed, bool together = false) {
  SampleSet set = smallHead(together);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  const auto fill = [&](Eigen::MatrixXd& part) {
    part.resize(part.rows(), size);
    for (double& value : part.reshaped()) value = normal(engine) * std::pow(10, 5 * normal(engine));
  };
  set.area.resize(size);
  for (Eigen::Index i = 0; i < size; ++i) set.area(i) = together ? -1 : static_cast<int>(i % 2);
  for (Eigen::MatrixXd* part : {&set.forces_N, &set.displacements_mm, &set.resistances_ohm}) fill(*part);
  return set;
}

/// The same as touches by an indenter.
inline SampleSet randomTouches(Eigen::Index size, unsigned seed) {
  SampleSet set = randomSet(size, seed);
  set.origin.areas = "touches";
  set.origin.touches = "sphere:3..6@3,3,27,27 press 0.5..6";
  std::mt19937_64 engine(seed);
  set.touches.resize(kTouchRows, size);
  for (Eigen::Index i = 0; i < size; ++i)
    set.touches.col(i) << static_cast<double>(i % 6), std::ldexp(double(engine() >> 11U), -50), 0.25,
        3 + 0.1 * double(i), std::ldexp(double(engine() >> 11U), -49);
  return set;
}

/// The same, two at once.
inline SampleSet randomPairs(Eigen::Index size, unsigned seed) {
  SampleSet set = randomTouches(size, seed);
  set.origin.touches = "sphere:3..6@3,3,27,27 at once 2 press 0.5..6";
  set.secondTouch.resize(kSecondTouchRows, size);
  set.secondTouch.topRows(kTouchRows) = randomTouches(size, seed + 1).touches;
  set.secondTouch.bottomRows<3>() = randomSet(size, seed + 1).forces_N;
  return set;
}

/// The same as another rig measures them: with time and place, and without displacements.
inline SampleSet randomMeasured(Eigen::Index size, unsigned seed) {
  SampleSet set = randomSet(size, seed);
  set.origin.mesh = std::string(kImportedFrom) + "table.csv";
  set.origin.perArea = 0; // of no request
  std::mt19937_64 engine(seed);
  set.times_s.resize(1, size);
  set.places_mm.resize(2, size);
  for (Eigen::MatrixXd* part : {&set.times_s, &set.places_mm})
    for (double& value : part->reshaped()) value = std::ldexp(double(engine() >> 11U), -50);
  set.displacements_mm.resize(0, size);
  return set;
}

inline SampleSet slice(const SampleSet& set, Eigen::Index first, Eigen::Index count) {
  SampleSet part = set;
  part.area = set.area.segment(first, count);
  for (const auto values : kSampleParts)
    if ((set.*values).rows() > 0) part.*values = (set.*values).middleCols(first, count);
  return part;
}

inline void expectSame(const SampleSet& a, const SampleSet& b) {
  EXPECT_EQ(difference(a.origin, b.origin), "");
  EXPECT_EQ(a.origin.firstSample, b.origin.firstSample);
  EXPECT_EQ(a.area, b.area);
  for (const auto values : kSampleParts) {
    ASSERT_EQ((a.*values).rows(), (b.*values).rows());
    if ((a.*values).rows() > 0) {
      EXPECT_EQ(a.*values, b.*values);
    }
  }
}

} // namespace palp
