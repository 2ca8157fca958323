#include "app/gui/live/SimulatedDesign.h"

#include "app/study/decoding/DecoderTraining.h"
#include "app/study/live/simulated/MovingTouch.h"
#include "app/study/touch/SampleGenerator.h"
#include "app/study/touch/Touch.h"
#include "model/base/Cancelled.h"
#include "solver/MeshCost.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int kPerArea = 24; // as many as ship for the paper's design: a polynomial of degree 2 an area
// Touches of the indenter over the face and its forces: what is read at one place has little to say two millimetres
// next to it. A mesh of hexahedra cannot resolve more than it has nodes.
constexpr int kMostToLearn = 1500, kFewestToLearn = 240;
constexpr double kNoise = 5e-6;  // of a good board
constexpr std::size_t kKept = 4; // designs

/// One sphere of a usual size that presses straight down.
TouchRange movingTouches(const SensorDesign& design) {
  TouchRange touches = touchesOf(design);
  touches.smallest_mm = touches.largest_mm = (touches.smallest_mm + touches.largest_mm) / 2;
  return touches;
}

int touchesOn(const MeshOptions& mesh) {
  if (!mesh.mapped) return kMostToLearn;
  return std::clamp((*mesh.mapped)[0] * (*mesh.mapped)[1] / 2, kFewestToLearn, kMostToLearn);
}

/// The board reads the design exactly where nothing touches it.
SampleSet withRest(const SampleSet& touches, const SensorDesign& design) {
  SampleSet all = touches, rest = samplesAt(touches, {0});
  rest.forces_N.setZero();
  rest.displacements_mm.setZero();
  rest.resistances_ohm.col(0) = resistancesAtRest_ohm(design).reshaped<Eigen::RowMajor>();
  append(all, rest);
  return all;
}

/// As many other touches of the same kind, with the board's readings: its network is trained on what it will read.
SampleSet answered(const SampleSet& board, const SensorDesign& design) {
  const MovingTouch response(board);
  const TouchRange touches = movingTouches(design);
  SampleSet all = board;
  all.displacements_mm.resize(0, all.size());
  for (Eigen::Index k = 0; k < all.size(); ++k) {
    const Indenter touch = touchAt(touches, board.origin.seed + 1, static_cast<std::size_t>(k));
    SimulatedTouch::Truth truth;
    truth.place_mm = touch.place_mm;
    truth.force_N = touch.press()->force_N;
    all.area(k) = areaUnder(design, touch.place_mm);
    all.touches(kTouchX_mm, k) = touch.place_mm.x();
    all.touches(kTouchY_mm, k) = touch.place_mm.y();
    all.forces_N.col(k) = truth.force_N;
    all.resistances_ohm.col(k) = response.resistances_ohm(truth).reshaped<Eigen::RowMajor>();
  }
  return all;
}

SampleSet solvedSamples(const SensorDesign& design, const MeshOptions& mesh, bool moving, const std::stop_token& stop,
                        JobProgress& progress) {
  SampleRequest request;
  request.perArea = moving ? touchesOn(mesh) : kPerArea;
  if (moving) request.touches = movingTouches(design);
  request.mesh = mesh;
  SampleGenerator generator(design, request);
  progress.set(-1, "Meshing the simulated design" + costInBrief(meshCost(design, generator.meshing())));
  SampleSet samples = generator.emptySet(stop);
  if (stop.stop_requested()) throw Cancelled();
  const auto total = static_cast<double>(generator.total());
  generator.generate(
      {0, generator.total()}, [&](const SampleSet& block) { append(samples, block); },
      [&](std::size_t done) {
        progress.set(static_cast<double>(done) / total, "Solving the simulated design: " + std::to_string(done) +
                                                            " of " + std::to_string(generator.total()) +
                                                            (moving ? " touches" : " loads"));
      },
      stop);
  if (stop.stop_requested()) throw Cancelled();
  return samples;
}

} // namespace

SimulatedDesign::SimulatedDesign(QObject* parent) : QObject(parent) {}

const SimulatedDesign::Solved* SimulatedDesign::of(const SensorDesign& design, bool moving) const {
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const auto& solved) {
    return solved->moving == moving && solved->design == design;
  });
  return found == kept_.end() ? nullptr : found->get();
}

void SimulatedDesign::solve(const SensorDesign& design, const MeshOptions& mesh, bool moving) {
  runner_.start(
      tr("Solving the simulated design"),
      [this, design, mesh, moving](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        auto samples = std::make_shared<const SampleSet>(solvedSamples(design, mesh, moving, stop, progress));
        TrainOptions options;
        options.input = InputKind::Resistance;
        options.rows = "all";
        options.decoder = moving ? DecoderKind::TouchInversion : DecoderKind::MaximumLikelihood;
        if (moving) options.target = DecoderTarget::ForceAndPlace;
        options.noise = kNoise;
        if (moving) samples = std::make_shared<const SampleSet>(withRest(*samples, design));
        progress.set(-1, "Training its network");
        Decoder decoder = trainDecoder(moving ? answered(*samples, design) : *samples, &design, options, stop);
        const auto solved = std::make_shared<const Solved>(Solved{design, moving, samples, std::move(decoder)});
        return [this, solved] {
          kept_.push_front(solved);
          if (kept_.size() > kKept) kept_.pop_back();
          emit this->solved();
        };
      });
}

} // namespace palp
