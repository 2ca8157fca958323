#include "app/study/decoding/KnownTouches.h"

#include "app/study/reports/map/TouchMap.h"
#include "app/study/touch/DesignMirror.h"
#include "io/DesignFile.h"
#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "model/TouchRange.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "solver/SensorMesh.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace palp {

namespace {

constexpr double kLeastPressesInRange = 6e6;

/// Indices of the decoder's inputs among the readings, row-wires first.
std::vector<Eigen::Index> readingsOf(const DecoderInput& input) {
  std::vector<Eigen::Index> places;
  for (const int row : input.rows)
    for (int column = 0; column < input.valuesPerRow; ++column)
      places.push_back(row + Eigen::Index(input.rowWires) * column);
  return places;
}

Indenter indenterOf(const SampleSet& samples) {
  const std::optional<Indenter> inWords = indenterInWords(samples.origin.touches);
  if (!samples.hasTouches() || !inWords)
    throw Error("the samples have no indenter; the prior mean from a design needs samples of palp sample --touch");
  if (inWords->shape != IndenterShape::Sphere && inWords->shape != IndenterShape::Pin &&
      inWords->shape != IndenterShape::Flat)
    throw DesignError(
        "indenter of the samples: " +
        gotExpected(shapeName(inWords->shape), "sphere, pin or flat, which have a position along x and y"));
  return *inWords;
}

} // namespace

double leastPress_N(const ForceRange& range) {
  return (range.high_N - range.low_N).maxCoeff() / kLeastPressesInRange;
}

/// A finer mesh leaves less at any number of samples, for about a minute more of CPU: whoever learns from few, as a
/// simulated board does, waits for that and not for the samples.
MeshOptions meshOfKnownTouches(const SensorDesign& design, Eigen::Index samples) {
  const TouchRange touches = touchesOf(design);
  return samples < manyTouchSamples ? meshForTouches(design, touches, {}) : meshToLearnFrom(design, touches, {});
}

KnownReadings knownReadings(const SensorDesign& design, const SampleSet& samples, const DecoderInput& input,
                            int threads, const std::stop_token& stop,
                            const std::function<void(double share, const std::string& what)>& progress) {
  const auto say = [&progress](double share, const std::string& what) {
    if (progress) progress(share, what);
  };
  if (samples.origin.designFingerprint != designFingerprint(design))
    throw Error("the samples are of the design " + samples.origin.designFingerprint + ", not of this one, " +
                designFingerprint(design));
  if (input.kind != InputKind::Resistance)
    throw Error("input: " + gotExpected(name(input.kind), "resistance for the prior mean from a design"));
  const Indenter indenter = indenterOf(samples);
  // Shares of the time on the paper's design with all row-wires.
  say(0, "the readings at rest");
  LinearReadings readings = readingsAtRest(design, threads, stop);
  const std::vector<Eigen::Index> used = readingsOf(input);
  readings.gradient_per_mm = Eigen::MatrixXd(readings.gradient_per_mm(used, Eigen::all));
  say(0.02, "a mesh of the block");
  const HyperelasticProblem problem(design, sensorMesh(design, meshOfKnownTouches(design, samples.size()), stop));
  say(0.04, "its factorisation");
  if (problem.findFactor(threads, stop) == 0) throw Cancelled();
  std::size_t done = 0;
  const auto surface = [&](std::size_t more) {
    const double share = static_cast<double>(done += more) / static_cast<double>(used.size());
    say(0.3 + 0.7 * share, "influence surface " + std::to_string(done) + " of " + std::to_string(used.size()));
  };
  surface(0);
  const auto found = InfluenceSurfaces::find(problem, readings, threads, stop, surface);
  if (!found) throw Cancelled();
  const Eigen::MatrixXd all_ohm = resistancesAtRest_ohm(design);
  const Eigen::VectorXd rest_ohm = all_ohm.reshaped()(used);
  const Eigen::Vector2d face_mm = design.block_mm.head<2>();
  return
      [surfaces = std::make_shared<const InfluenceSurfaces>(*found), indenter, rest_ohm, face_mm,
       least_N = leastPress_N(design.forceRange), threads, stop](const Eigen::MatrixXd& parameters) -> Eigen::MatrixXd {
        std::vector<Indenter> touches(static_cast<std::size_t>(parameters.cols()), indenter);
        for (std::size_t i = 0; i < touches.size(); ++i) {
          const auto column = parameters.col(static_cast<Eigen::Index>(i));
          touches[i].radius_mm = column(5);
          // The place of a table's outermost nodes may lie off the face.
          touches[i].place_mm = column.segment<2>(3).cwiseMax(0).cwiseMin(face_mm);
          touches[i].control = Press{{column(0), column(1), std::min(column(2), -least_N)}};
        }
        const Eigen::MatrixXd changes = surfaces->under(touches, threads, stop);
        return rest_ohm.asDiagonal() * (1 + changes.array()).matrix();
      };
}

std::vector<KernelMirror> mirrorsOfTouches(const SensorDesign& design, const Eigen::MatrixXd& parameters,
                                           const DecoderInput& input) {
  std::vector<KernelMirror> mirrors;
  for (int axis = 0; axis < 2; ++axis) {
    const std::optional<DesignMirror> mirror = mirrorOf(design, axis);
    if (!mirror) continue;
    KernelMirror found;
    found.about = {{axis, 0.}, {3 + axis, design.block_mm(axis) / 2}}; // force and position
    const bool reflected = std::all_of(found.about.begin(), found.about.end(), [&](const auto& parameter) {
      const auto values = parameters.row(parameter.first);
      return values.minCoeff() < values.maxCoeff() || values(0) == parameter.second;
    });
    for (std::size_t k = 0; reflected && k < input.rows.size(); ++k) {
      const auto image =
          std::find(input.rows.begin(), input.rows.end(), mirror->row[static_cast<std::size_t>(input.rows[k])]);
      if (image == input.rows.end()) break;
      for (const int column : mirror->column)
        found.measurement.push_back((image - input.rows.begin()) * Eigen::Index(input.valuesPerRow) + column);
    }
    if (static_cast<int>(found.measurement.size()) == static_cast<int>(input.rows.size()) * input.valuesPerRow)
      mirrors.push_back(std::move(found));
  }
  return mirrors;
}

} // namespace palp
