#include "solver/mesh/DelaunayTets.h"

#include "model/DesignError.h"
#include "model/base/Cancelled.h"

#include <Eigen/SVD>

// Debian's library frees its mesh before it throws and once more in the mesh's destructor, so it crashes where it means
// to throw. Its functions call the program's definition of `terminatetetgen` where there is one: this one leaves the
// mesh to the destructor.
#define terminatetetgen terminatetetgenOfTheHeader
#include <tetgen.h>
#undef terminatetetgen

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <future>
#include <memory>
#include <mutex>
#include <thread>

void terminatetetgen(tetgenmesh* mesh, int code);
void terminatetetgen(tetgenmesh*, int code) {
  throw code;
}

namespace palp {

namespace {

constexpr Eigen::Index callsWithoutLooking = 20000; // points that TetGen takes less than 0.2 s for
constexpr std::chrono::milliseconds lookEvery{20};

/// Where this thread's standard output goes while TetGen works in it.
thread_local std::string* printed = nullptr;

ssize_t writeQuietly(void* standardOutput, const char* text, std::size_t size) {
  if (!printed) return static_cast<ssize_t>(std::fwrite(text, 1, size, static_cast<FILE*>(standardOutput)));
  printed->append(text, size);
  return static_cast<ssize_t>(size);
}

/// TetGen prints its reason with printf even where it is to be quiet, and standard output is for results. While it
/// works, the C library's `stdout` is a stream that keeps what its thread prints and passes on what any other prints.
class QuietOutput {
public:
  explicit QuietOutput(std::string& text) : real_(stdout) {
    static FILE* const stream = open(real_); // never closed: another thread may be about to print to it
    printed = &text;
    if (stream) stdout = stream;
  }
  ~QuietOutput() {
    stdout = real_;
    printed = nullptr;
  }
  QuietOutput(const QuietOutput&) = delete;
  QuietOutput& operator=(const QuietOutput&) = delete;

private:
  static FILE* open(FILE* real) {
    FILE* stream = fopencookie(real, "w", {nullptr, writeQuietly, nullptr, nullptr});
    if (stream) std::setvbuf(stream, nullptr, _IONBF, 0);
    return stream;
  }
  FILE* real_;
};

} // namespace

void tetrahedralise(std::string switches, tetgenio& in, tetgenio& out) {
  static std::mutex oneCall;
  const std::lock_guard lock(oneCall);
  std::string text;
  try {
    const QuietOutput quiet(text);
    ::tetrahedralize(switches.data(), &in, &out);
  } catch (int code) {
    const std::string reason = text.empty() ? "no reason given" : text.substr(0, text.find('\n'));
    throw DesignError("mesh: TetGen cannot mesh this block (its error " + std::to_string(code) + ": " + reason + ")");
  }
}

namespace {

/// TetGen ends the program at an assertion, or worse, where these are not so.
void requireSolid(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights) {
  if (points.cols() < 4) throw DesignError("mesh: fewer than four points; a tetrahedron takes four");
  if (!points.allFinite() || !weights.allFinite())
    throw DesignError("mesh: a point with a coordinate that is not finite");
  const Eigen::Vector3d centre = points.rowwise().mean();
  const Eigen::Matrix3d spread = (points.colwise() - centre) * (points.colwise() - centre).transpose();
  const Eigen::Vector3d extents = spread.jacobiSvd().singularValues().cwiseSqrt();
  if (!(extents(2) > 1e-6 * extents(0)))
    throw DesignError("mesh: all points lie in one plane; the block has no volume");
}

struct Call {
  tetgenio in, out; // their destructors free the arrays

  Call(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights) {
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>(points.cols());
    in.numberofpointattributes = 1;
    in.pointlist = new REAL[points.size()];
    in.pointattributelist = new REAL[weights.size()];
    std::copy(points.data(), points.data() + points.size(), in.pointlist);
    std::copy(weights.data(), weights.data() + weights.size(), in.pointattributelist);
  }
  void run() { tetrahedralise("wQ", in, out); } // weighted, quiet
};

/// TetGen cannot be interrupted. In a thread of its own it can be left to itself: it ends within seconds, with nobody
/// waiting for what it finds.
void runUnlessStopped(const std::shared_ptr<Call>& call, const std::stop_token& stop) {
  std::packaged_task<void()> task([call] { call->run(); });
  std::future<void> done = task.get_future();
  std::thread(std::move(task)).detach();
  while (done.wait_for(lookEvery) != std::future_status::ready) throwIfStopped(stop);
  done.get();
}

} // namespace

LinearTets weightedDelaunay(const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights,
                            const std::stop_token& stop) {
  requireSolid(points, weights);
  throwIfStopped(stop);
  const auto call = std::make_shared<Call>(points, weights);
  if (points.cols() > callsWithoutLooking && stop.stop_possible())
    runUnlessStopped(call, stop);
  else
    call->run();
  LinearTets tets;
  tets.corners = Eigen::Map<Eigen::Matrix4Xi>(call->out.tetrahedronlist, 4, call->out.numberoftetrahedra);
  tets.hull = Eigen::Map<Eigen::Matrix3Xi>(call->out.trifacelist, 3, call->out.numberoftrifaces);
  return tets;
}

} // namespace palp
