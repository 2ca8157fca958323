#include "app/study/reports/errortime/CalculixRun.h"
#include "model/SensorDesign.h"
#include "solver/HyperelasticProblem.h"
#include "solver/SensorMesh.h"

#include <gtest/gtest.h>

TEST(CalculixResult, ReadsTheLastStepsDisplacementsByNode) {
  const std::string frd = " -4  DISP        4    1\n"
                          " -1         1 1.00000E+00 0.00000E+00 0.00000E+00\n"
                          " -3\n"
                          " -4  DISP        4    1\n"
                          " -5  D1          1    2    1    0\n"
                          " -1         1 1.00000E-03-2.00000E-03 3.00000E-03\n"
                          " -1         2 4.00000E+00 5.00000E+00-6.00000E+00\n"
                          " -3\n"
                          " -4  STRESS      6    1\n"
                          " -1         1 9.00000E+00 9.00000E+00 9.00000E+00\n"
                          " -3\n";
  const Eigen::Matrix3Xd displacements = palp::frdDisplacements(frd, 2);
  ASSERT_EQ(displacements.cols(), 2);
  EXPECT_EQ(displacements.col(0), Eigen::Vector3d(1e-3, -2e-3, 3e-3));
  EXPECT_EQ(displacements.col(1), Eigen::Vector3d(4, 5, -6));
}

TEST(CalculixResult, ReadsTheLastForceOfTheClampedFace) {
  const std::string dat = "\n total force (fx,fy,fz) for set BOTTOM and time  0.5000000E+00\n\n"
                          "        1.000000E+00  0.000000E+00  2.000000E+00\n"
                          "\n total force (fx,fy,fz) for set BOTTOM and time  0.1000000E+01\n\n"
                          "        6.731472E-16 -6.005396E-16  3.657995E+00\n";
  const auto force_N = palp::datReaction_N(dat);
  ASSERT_TRUE(force_N);
  EXPECT_EQ(force_N->z(), 3.657995);
  EXPECT_FALSE(palp::datReaction_N("displacements\n"));
  EXPECT_FALSE(palp::datReaction_N(" total force (fx,fy,fz) for set BOTTOM and time  0.1000000E+01\n\n"));
}

TEST(CalculixResult, IsEmptyWithoutDisplacements) {
  EXPECT_EQ(palp::frdDisplacements("    1C\n", 2).size(), 0);
}

namespace {

/// Relative difference of CalculiX's displacements to ours on n x n x n/2 hexahedra.
double difference(const std::string& program, int n) {
  palp::SensorDesign design = palp::paperDesign();
  design.material.poissonRatio = 0.3; // far from incompressible, where its displacement elements lock
  palp::MeshOptions mapped;
  mapped.mapped = std::array<int, 3>{n, n, n / 2};
  const palp::Mesh mesh = sensorMesh(design, mapped);
  palp::LoadCase load;
  load.areas.push_back({0, {0.1, 0, -0.5}});
  const palp::CalculixRun run = runCalculix(program, design, mesh, load, 1, 60, {});
  EXPECT_EQ(run.failed, "");
  const palp::HyperelasticProblem problem(design, mesh);
  const Eigen::Matrix3Xd ours = problem.solve(load).state().displacements_mm;
  return (run.displacements_mm - ours).norm() / ours.norm();
}

} // namespace

TEST(CalculixRun, OfACompressibleBlockConvergesToTheSameAnswer) {
  const auto program = palp::calculixProgram();
  if (!program) GTEST_SKIP() << "ccx is not installed";
  // Two kinds of elements differ by their discretisation errors, which fall with the square of the size where the
  // solution is smooth and more slowly at the borders of the load. Another load or material would not fall.
  EXPECT_LT(difference(*program, 12), 0.5 * difference(*program, 6));
}
