#include "solver/mesh/DelaunayTets.h"

#include "model/DesignError.h"
#include "model/base/Cancelled.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#define TETLIBRARY
#define terminatetetgen terminatetetgenOfTheHeader // the program's own stands in solver/mesh/DelaunayTets.cpp
#include <tetgen.h>
#undef terminatetetgen

#include <array>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>

using namespace palp;

namespace {

/// A grid of n x n x n points in a cube of that many units.
Eigen::Matrix3Xd grid(int n) {
  Eigen::Matrix3Xd points(3, n * n * n);
  for (int p = 0; p < points.cols(); ++p) points.col(p) << p % n, p / n % n, p / (n * n); // NOLINT(*-integer-division)
  return points;
}

/// Volume of all tetrahedra, each counted as positive.
double volume(const Eigen::Matrix3Xd& points, const LinearTets& tets) {
  double sum = 0;
  for (Eigen::Index e = 0; e < tets.corners.cols(); ++e) {
    Eigen::Matrix3d edges;
    for (int i = 0; i < 3; ++i) edges.col(i) = points.col(tets.corners(i + 1, e)) - points.col(tets.corners(0, e));
    sum += std::abs(edges.determinant()) / 6;
  }
  return sum;
}

/// A tetrahedron one of whose facets is given twice.
void describeTwiceTheSameFacet(tetgenio& in) {
  static constexpr std::array<double, 12> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  static constexpr std::array<std::array<int, 3>, 5> facets{{{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}, {0, 1, 2}}};
  in.firstnumber = 0;
  in.numberofpoints = 4;
  in.pointlist = new REAL[points.size()];
  std::copy(points.begin(), points.end(), in.pointlist);
  in.numberoffacets = static_cast<int>(facets.size());
  in.facetlist = new tetgenio::facet[facets.size()];
  for (std::size_t f = 0; f < facets.size(); ++f) {
    tetgenio::facet& facet = in.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    facet.polygonlist[0].numberofvertices = 3;
    facet.polygonlist[0].vertexlist = new int[3];
    std::copy(facets[f].begin(), facets[f].end(), facet.polygonlist[0].vertexlist);
  }
}

TEST(TetGen, RefusesAFacetThatIsThereTwiceWithItsOwnReasonAndKeepsStandardOutputClean) {
  for (int again = 0; again < 3; ++again) { // the library's mesh is freed once a call
    tetgenio in, out;
    describeTwiceTheSameFacet(in);
    testing::internal::CaptureStdout();
    std::string sentence;
    try {
      tetrahedralise("pQ", in, out);
    } catch (const DesignError& error) {
      sentence = error.what();
    }
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_NE(sentence.find("error 3"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("duplicated facets"), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
  }
}

TEST(TetGen, LetsOtherThreadsPrintWhileItWorks) {
  testing::internal::CaptureStdout();
  std::jthread meshing([] { static_cast<void>(weightedDelaunay(grid(30), Eigen::VectorXd::Zero(27000))); });
  std::string expected;
  for (int i = 0; i < 100; ++i) {
    std::printf("%d\n", i);
    std::fflush(stdout);
    expected += std::to_string(i) + "\n";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  meshing.join();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), expected);
}

TEST(TetGen, MeshesBodiesOfDifferentSizeFromManyThreads) {
  const std::array<double, 2> sizes{1, 1000};
  std::array<double, 2> sums{};
  {
    std::array<std::jthread, 2> threads;
    for (std::size_t t = 0; t < 2; ++t)
      threads[t] = std::jthread([&, t] {
        for (int again = 0; again < 20; ++again) {
          const Eigen::Matrix3Xd points = sizes[t] * grid(6);
          sums[t] += volume(points, weightedDelaunay(points, Eigen::VectorXd::Zero(points.cols())));
        }
      });
  }
  for (std::size_t t = 0; t < 2; ++t) EXPECT_NEAR(sums[t] / (20 * std::pow(5 * sizes[t], 3)), 1, 1e-12); // rounding
}

TEST(WeightedDelaunay, RefusesPointsThatSpanNoVolume) {
  Eigen::Matrix3Xd flat = grid(3), line = grid(3), none = grid(3);
  flat.row(2) = flat.row(0) + flat.row(1);
  line.bottomRows<2>().setZero();
  none(1, 7) = std::nan("");
  for (const Eigen::Matrix3Xd& points : {flat, line, none, Eigen::Matrix3Xd(grid(3).leftCols(3)),
                                         Eigen::Matrix3Xd(Eigen::Matrix3Xd::Zero(3, 9)), Eigen::Matrix3Xd(3, 0)})
    EXPECT_THROW(static_cast<void>(weightedDelaunay(points, Eigen::VectorXd::Zero(points.cols()))), DesignError);
}

TEST(WeightedDelaunay, StopsInTheMiddleAndMeshesAgain) {
  std::stop_source stop;
  std::jthread asking([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    stop.request_stop();
  });
  const Eigen::Matrix3Xd points = grid(45); // half a second's work
  EXPECT_THROW(static_cast<void>(weightedDelaunay(points, Eigen::VectorXd::Zero(points.cols()), stop.get_token())),
               Cancelled);
  const Eigen::Matrix3Xd few = grid(4);
  EXPECT_NEAR(volume(few, weightedDelaunay(few, Eigen::VectorXd::Zero(few.cols()))), 27, 1e-12);
}

} // namespace
