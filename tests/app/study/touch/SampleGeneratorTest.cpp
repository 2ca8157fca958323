#include "app/study/touch/SampleGenerator.h"
#include "model/DesignError.h"

#include <gtest/gtest.h>

using namespace palp;

namespace {

SampleRequest coarse(int perArea) {
  SampleRequest request;
  request.perArea = perArea;
  request.mesh.mapped = std::array<int, 3>{3, 4, 2};
  return request;
}

} // namespace

TEST(SampleGenerator, DrawsForcesInsideTheRange) {
  const SensorDesign design = paperDesign();
  const SampleGenerator generator(design, coarse(200));
  ASSERT_EQ(generator.total(), 1200U);
  for (std::size_t i = 0; i < generator.total(); ++i) {
    const LoadCase load = generator.load(i);
    ASSERT_EQ(load.areas.size(), 1U);
    EXPECT_EQ(load.areas[0].area, static_cast<int>(i / 200));
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GE(load.areas[0].force_N(axis), design.forceRange.low_N(axis));
      EXPECT_LE(load.areas[0].force_N(axis), design.forceRange.high_N(axis));
    }
  }
}

TEST(SampleGenerator, GivesTheMeshThatItsSamplesNeedBeforeItIsMade) {
  SampleRequest request;
  request.perArea = 4;
  EXPECT_EQ(SampleGenerator(paperDesign(), request).meshing(), request.mesh);
  request.touches = touchesOf(paperDesign());
  EXPECT_FALSE(SampleGenerator(paperDesign(), request).meshing().zones.empty());
}

TEST(SampleGenerator, ForcesAreUniformAndUncorrelated) {
  const SampleGenerator generator(paperDesign(), coarse(2000));
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  const auto n = static_cast<double>(generator.total());
  for (std::size_t i = 0; i < generator.total(); ++i) {
    const Eigen::Vector3d f = generator.load(i).areas[0].force_N.cwiseQuotient(Eigen::Vector3d(1, 1, 3)) +
                              Eigen::Vector3d(0, 0, 1); // now uniform over [-1, 1]
    mean += f / n;
    products += f * f.transpose() / n;
  }
  // Standard errors: 0.577/sqrt(12000) = 0.0053 for the mean, about 0.003 for the products; 5 of them.
  EXPECT_LT(mean.cwiseAbs().maxCoeff(), 0.027);
  EXPECT_LT((products - Eigen::Matrix3d::Identity() / 3).cwiseAbs().maxCoeff(), 0.016);
}

TEST(SampleGenerator, ASampleDoesNotDependOnHowManyThereAre) {
  const SampleGenerator few(paperDesign(), coarse(5));
  const SampleGenerator many(paperDesign(), coarse(50));
  EXPECT_EQ(few.load(3), many.load(3));
  EXPECT_EQ(few.load(7), many.load(52)); // sample 2 of area 1
}

TEST(SampleGenerator, AnyRangeGivesTheSameNumbers) {
  SampleGenerator whole(paperDesign(), coarse(9));
  SampleGenerator part(paperDesign(), coarse(9));
  SampleSet all;
  SampleSet some;
  whole.generate({0, whole.total()}, [&](const SampleSet& block) { append(all, block); });
  part.generate({17, 31}, [&](const SampleSet& block) { append(some, block); });
  ASSERT_EQ(all.size(), 54);
  ASSERT_EQ(some.size(), 14);
  EXPECT_EQ(some.displacements_mm, all.displacements_mm.middleCols(17, 14));
  EXPECT_EQ(some.resistances_ohm, all.resistances_ohm.middleCols(17, 14));
}

TEST(SampleGenerator, StopsWhenAsked) {
  SampleGenerator generator(paperDesign(), coarse(1000));
  std::stop_source source;
  source.request_stop();
  EXPECT_EQ(generator.generate(
                {0, generator.total()}, [](const SampleSet&) {}, {}, source.get_token()),
            0U);
  EXPECT_TRUE(generator.stages().counts().empty());
}

TEST(SampleGenerator, ShardsPartTheSamples) {
  std::size_t next = 0;
  for (int i = 1; i <= 7; ++i) {
    const SampleRange range = shard(100, i, 7);
    EXPECT_EQ(range.first, next);
    next = range.last;
  }
  EXPECT_EQ(next, 100U);
}

TEST(SampleGenerator, TouchesAreFullSolvesOfTheirIndenters) {
  SampleRequest request = coarse(6);
  request.mesh.mapped = std::array<int, 3>{12, 12, 2};
  request.touches = touchesOf(paperDesign());
  SampleGenerator generator(paperDesign(), request);
  ASSERT_EQ(generator.total(), 6U);
  SampleSet all, part;
  generator.generate({0, 6}, [&](const SampleSet& block) { append(all, block); });
  SampleGenerator(paperDesign(), request).generate({4, 6}, [&](const SampleSet& block) { append(part, block); });
  EXPECT_EQ(all.origin.areas, "touches");
  EXPECT_EQ(all.origin.touches, inWords(*request.touches));
  EXPECT_EQ(part.displacements_mm, all.displacements_mm.rightCols(2));
  EXPECT_EQ(part.touches, all.touches.rightCols(2));
  const HyperelasticProblem problem(paperDesign(), sensorMesh(paperDesign(), request.mesh));
  for (const Eigen::Index i : {0, 5}) {
    const LoadCase load = generator.load(static_cast<std::size_t>(i));
    ASSERT_EQ(load.indenters.size(), 1U);
    EXPECT_EQ(all.forces_N.col(i), load.indenters[0].press()->force_N);
    EXPECT_EQ(all.area(i), areaUnder(paperDesign(), load.indenters[0].place_mm));
    EXPECT_EQ(all.touches(kTouchSize_mm, i), load.indenters[0].radius_mm);
    const Solution full = problem.solve(load);
    ASSERT_TRUE(full.converged);
    const Eigen::VectorXd expected = problem.electrodes(full.state()).upper_mm.reshaped();
    EXPECT_LT((all.displacements_mm.col(i) - expected).norm(), 1e-4 * expected.norm()) << i;
  }
}

TEST(SampleGenerator, PartsOfTheFaceHaveMeshesOfTheirOwn) {
  SensorDesign design = paperDesign();
  design.block_mm.x() = 60;
  design.lower.wire_mm[0] += 0.1; // not its own image along x
  SampleRequest request = coarse(5);
  request.mesh.mapped.reset();
  request.mesh.meshSize_mm = 3 * standardMeshSize_mm(design);
  request.relativeTolerance = 1e-5;
  request.touches = touchesOf(design);
  request.touches->low_mm.y() = 14;
  request.touches->high_mm.y() = 16;
  request.touches->leastPress_N = request.touches->mostPress_N = 3;
  const std::vector<TouchRange> parts = partsOfTouches(design, *request.touches, request.mesh);
  ASSERT_EQ(parts.size(), 2U);
  SampleGenerator generator(design, request), another(design, request);
  SampleSet all, part;
  generator.generate({0, 5}, [&](const SampleSet& block) { append(all, block); });
  another.generate({3, 5}, [&](const SampleSet& block) { append(part, block); });
  EXPECT_EQ(part.displacements_mm, all.displacements_mm.rightCols(2));
  EXPECT_EQ(part.origin.mesh, all.origin.mesh);
  EXPECT_EQ(generator.stages().runs("mesh"), 2);
  EXPECT_GT(generator.measuredError(), 0);
  EXPECT_LT(generator.measuredError(), 1e-4);
  const LoadCase load = generator.load(4);
  const TouchRange& own = parts[load.indenters[0].place_mm.x() < parts[1].low_mm.x() ? 0 : 1];
  const HyperelasticProblem problem(design, sensorMesh(design, meshForPart(design, own, request.mesh)));
  const Eigen::VectorXd expected = problem.electrodes(problem.solve(load).state()).upper_mm.reshaped();
  EXPECT_LT((all.displacements_mm.col(4) - expected).norm(), 1e-4 * expected.norm());
}

TEST(SampleGenerator, ImagesInMirrorsShareAMesh) {
  const SensorDesign design = paperDesign();
  SampleRequest request = coarse(3);
  request.mesh.mapped.reset();
  request.mesh.meshSize_mm = 3 * standardMeshSize_mm(design);
  request.relativeTolerance = 1e-5;
  request.touches = touchesOf(design);
  SampleGenerator generator(design, request);
  SampleSet all;
  generator.generate({0, 3}, [&](const SampleSet& block) { append(all, block); });
  EXPECT_EQ(generator.stages().runs("mesh"), 1);
  EXPECT_GT((all.touchedPlaces_mm().array() > 15).colwise().any().count(), 0) << "some were solved as their images";
}

TEST(SampleGenerator, ImagesInMirrorsAreTheTouchesThemselves) {
  const SensorDesign design = paperDesign();
  SampleRequest request = coarse(8);
  request.mesh.mapped = std::array<int, 3>{12, 12, 2}; // its own image, so that both are the same to the tolerance
  request.touches = touchesOf(design);
  SampleGenerator generator(design, request);
  SampleSet all;
  generator.generate({0, 8}, [&](const SampleSet& block) { append(all, block); });
  const HyperelasticProblem problem(design, sensorMesh(design, request.mesh));
  std::array<bool, 2> beyond{};
  for (std::size_t i = 0; i < 8; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const LoadCase load = generator.load(i);
    EXPECT_EQ(all.touchedPlaces_mm().col(column), load.indenters[0].place_mm);
    for (const int axis : {0, 1}) beyond[static_cast<std::size_t>(axis)] |= load.indenters[0].place_mm(axis) > 15;
    const ElectrodeDisplacements moved = problem.electrodes(problem.solve(load).state());
    const Eigen::VectorXd expected = moved.upper_mm.reshaped();
    EXPECT_LT((all.displacements_mm.col(column) - expected).norm(), 1e-4 * expected.norm()) << i;
    const Eigen::VectorXd read = rowColumnResistances(design, moved).reshaped<Eigen::RowMajor>();
    EXPECT_TRUE(all.resistances_ohm.col(column).isApprox(read, 1e-4)) << i;
  }
  EXPECT_TRUE(beyond[0] && beyond[1]) << "both mirrors are used";
}

TEST(SampleGenerator, SurrogatesOfTheFieldAreFittedToOneOfEachAreaAndItsImages) {
  SensorDesign design = paperDesign();
  FieldLaw law;
  law.readout = Readout::VirtualGround;
  design.resistance = law;
  SampleRequest request = coarse(2);
  request.mesh.mapped = std::array<int, 3>{6, 6, 2}; // its own image
  request.surrogate = true;
  SampleGenerator generator(design, request);
  std::size_t fitted = 0;
  generator.whileFitting([&](std::size_t, std::size_t of) { fitted = of; });
  SampleSet all;
  generator.generate({0, generator.total()}, [&](const SampleSet& block) { append(all, block); });
  EXPECT_EQ(fitted, 2u);
  request.surrogate = false;
  SampleGenerator solving(design, request);
  SampleSet expected;
  solving.generate({0, solving.total()}, [&](const SampleSet& block) { append(expected, block); });
  ASSERT_EQ(all.size(), 12);
  for (Eigen::Index i = 0; i < all.size(); ++i) {
    EXPECT_LT((all.displacements_mm.col(i) - expected.displacements_mm.col(i)).norm(),
              1e-4 * expected.displacements_mm.col(i).norm())
        << i;
    EXPECT_TRUE(all.resistances_ohm.col(i).isApprox(expected.resistances_ohm.col(i), 1e-4)) << i;
  }
}

TEST(SampleGenerator, TwoTouchesAtOnceAreOneSolve) {
  SampleRequest request = coarse(4);
  request.mesh.mapped = std::array<int, 3>{12, 12, 2};
  request.touches = touchesOf(paperDesign());
  request.touches->atOnce = 2;
  request.touches->leastFriction = request.touches->mostFriction = 0.5;
  SampleGenerator generator(paperDesign(), request);
  SampleSet all;
  generator.generate({0, 4}, [&](const SampleSet& block) { append(all, block); });
  ASSERT_EQ(all.secondTouch.rows(), kSecondTouchRows);
  const HyperelasticProblem problem(paperDesign(), sensorMesh(paperDesign(), request.mesh));
  for (const Eigen::Index i : {0, 3}) {
    const LoadCase load = generator.load(static_cast<std::size_t>(i));
    ASSERT_EQ(load.indenters.size(), 2U);
    EXPECT_EQ(all.secondTouch.col(i).segment<2>(kTouchX_mm), load.indenters[1].place_mm);
    EXPECT_EQ(all.secondTouch.col(i).tail<3>(), load.indenters[1].press()->force_N);
    const Solution full = problem.solve(load);
    ASSERT_TRUE(full.converged);
    const Eigen::VectorXd expected = problem.electrodes(full.state()).upper_mm.reshaped();
    EXPECT_LT((all.displacements_mm.col(i) - expected).norm(), 1e-4 * expected.norm()) << i;
  }
}

// A ball that friction hardly holds is pushed off the corner in some directions, and not in others.
TEST(SampleGenerator, DrawsATouchAnewThatHasNoEquilibrium) {
  SampleRequest request = coarse(5);
  request.mesh.mapped = std::array<int, 3>{15, 15, 2};
  request.touches = touchesOf(paperDesign());
  request.touches->smallest_mm = request.touches->largest_mm = 5;
  request.touches->low_mm = {0.5, 0.5};
  request.touches->high_mm = {0.8, 0.8};
  request.touches->leastFriction = request.touches->mostFriction = 0.6;
  request.touches->cone = 0.9;
  request.touches->leastPress_N = request.touches->mostPress_N = 3;
  SampleGenerator generator(paperDesign(), request), one(paperDesign(), request);
  SampleSet all, last;
  ASSERT_EQ(generator.generate({0, 5}, [&](const SampleSet& block) { append(all, block); }), 5U);
  EXPECT_GT(generator.redrawn(), 0);
  EXPECT_NE(generator.whyRedrawn().find(": the contact iteration did not converge"), std::string::npos);
  int changed = 0;
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(all.forces_N.col(i), generator.load(static_cast<std::size_t>(i)).indenters[0].press()->force_N);
    changed += all.forces_N.col(i) != touchAt(*request.touches, request.seed, std::size_t(i)).press()->force_N ? 1 : 0;
  }
  EXPECT_GT(changed, 0);
  EXPECT_LE(changed, generator.redrawn());
  EXPECT_GT(all.displacements_mm.colwise().norm().minCoeff(), 0);
  one.generate({3, 5}, [&](const SampleSet& block) { append(last, block); });
  EXPECT_EQ(last.forces_N, all.forces_N.rightCols(2)) << "whatever was drawn beside it";
  EXPECT_EQ(last.displacements_mm, all.displacements_mm.rightCols(2));
}

TEST(SampleGenerator, EndsWhereNoTouchHasAnEquilibrium) {
  SampleRequest request = coarse(1);
  request.mesh.mapped = std::array<int, 3>{15, 15, 2};
  request.touches = touchesOf(paperDesign());
  request.touches->leastPress_N = request.touches->mostPress_N = 900; // deeper than the block is high
  try {
    SampleGenerator(paperDesign(), request).generate({0, 1}, [](const SampleSet&) {});
    FAIL() << "there is no such touch";
  } catch (const ConvergenceError& refusal) {
    EXPECT_EQ(std::string(refusal.what()).find("touch 0: "), 0U) << refusal.what();
    EXPECT_NE(std::string(refusal.what()).find("20 replacements"), std::string::npos) << refusal.what();
  }
}

TEST(SampleGenerator, RefusesTouchesThatCannotBe) {
  SampleRequest request = coarse(2);
  request.touches = touchesOf(paperDesign());
  request.surrogate = true;
  EXPECT_THROW(SampleGenerator(paperDesign(), request), DesignError);
  request.surrogate = false;
  request.touches->low_mm.x() = -1;
  EXPECT_THROW(SampleGenerator(paperDesign(), request), DesignError);
}

TEST(SampleGenerator, RefusesAnUnknownArea) {
  SampleRequest request = coarse(1);
  request.areas = "6";
  EXPECT_THROW(SampleGenerator(paperDesign(), request), DesignError);
}

TEST(SampleGenerator, NamesTheSampleThatHasNoSolution) {
  SensorDesign design = paperDesign();
  design.forceRange = {{-9e5, -9e5, -9e5}, {9e5, 9e5, -8e5}}; // far beyond what any rubber bears
  SampleGenerator generator(design, coarse(100));
  try {
    generator.generate({150, 152}, [](const SampleSet&) {});
    FAIL() << "there is no such solution";
  } catch (const ConvergenceError& refusal) {
    EXPECT_EQ(std::string(refusal.what()).find("load 150: "), 0U) << refusal.what();
  }
}

TEST(SampleGenerator, AnotherSeedNeedsNoOtherPreparation) {
  SampleRequest second = coarse(2);
  second.seed = 7;
  SampleGenerator generator(paperDesign(), coarse(2)), alone(paperDesign(), second);
  const auto all = [](SampleGenerator& from) {
    SampleSet made;
    EXPECT_EQ(from.generate({0, from.total()}, [&](const SampleSet& block) { made = block; }), from.total());
    return made;
  };
  const SampleSet first = all(generator);
  generator.setSeed(7);
  const SampleSet next = all(generator), wanted = all(alone);
  EXPECT_EQ(next.origin.seed, 7u);
  EXPECT_EQ(next.resistances_ohm, wanted.resistances_ohm);
  EXPECT_NE(next.forces_N, first.forces_N);
  EXPECT_EQ(generator.stages().runs("mesh"), 1);
}

TEST(SampleGenerator, SaysWhichAreaItFitsASurrogateTo) {
  SampleRequest request = coarse(1);
  request.surrogate = true;
  const std::vector<std::vector<std::size_t>> expected{{0, 1, 2, 3, 4, 5}, {0, 2, 4}}; // as many at once as threads
  for (const int threads : {1, 2}) {
    request.threads = threads;
    SampleGenerator generator(paperDesign(), request);
    std::vector<std::size_t> said;
    generator.whileFitting([&](std::size_t done, std::size_t all) {
      said.push_back(done);
      EXPECT_EQ(all, 6u);
    });
    generator.emptySet();
    EXPECT_EQ(said, expected[static_cast<std::size_t>(threads - 1)]);
  }
}
