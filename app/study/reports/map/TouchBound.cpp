#include "app/study/reports/map/TouchBound.h"

#include "app/study/Median.h"
#include "io/DesignFile.h"
#include "model/DesignError.h"
#include "model/TouchRange.h"
#include "model/base/GotExpected.h"

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kMedianOfNormal = 0.67449;    // of |z|, z normal with deviation 1
constexpr double kSizeStep = 0.02;             // relative, of the difference that the slope is taken from
constexpr Eigen::Index kTouchParameters = 7;   // of DecoderTraining::fitTouches: force, place, size, friction
constexpr double kMedianOfRayleigh = 1.177410; // of a distance in the plane whose coordinates have deviation 1

Indenter touchOf(const SampleSet& samples, Eigen::Index i) {
  Indenter touch;
  touch.shape = static_cast<IndenterShape>(std::lround(samples.touches(kTouchShape, i)));
  touch.radius_mm = samples.touches(kTouchSize_mm, i);
  touch.place_mm = samples.touches.block<2, 1>(kTouchX_mm, i);
  touch.control = Press{{0, 0, samples.forces_N(2, i)}};
  return touch;
}

std::vector<Indenter> resized(std::vector<Indenter> touches, double factor) {
  for (Indenter& touch : touches) touch.radius_mm *= factor;
  return touches;
}

} // namespace

std::optional<SampleBounds> touchBounds(const SampleSet& samples, const SensorDesign& design, double relativeNoise,
                                        const MeshOptions& mesh, int threads, const std::stop_token& stop) {
  if (!samples.hasTouches()) throw Error("the samples are of no touches; their bound needs no design");
  if (samples.origin.designFingerprint != designFingerprint(design))
    throw Error("the samples are of the design " + samples.origin.designFingerprint + ", not of this one, " +
                designFingerprint(design));
  std::vector<Indenter> touches;
  for (Eigen::Index i = 0; i < samples.size(); ++i) touches.push_back(touchOf(samples, i));
  for (const Indenter& touch : touches)
    if (touch.shape != IndenterShape::Sphere && touch.shape != IndenterShape::Pin && touch.shape != IndenterShape::Flat)
      throw DesignError("indenter of the samples: " +
                        gotExpected(shapeName(touch.shape),
                                    "sphere, pin or flat, which have a position along x and y, for their bound"));
  const LinearReadings readings = readingsAtRest(design, threads, stop);
  const HyperelasticProblem problem(design, sensorMesh(design, meshForTouches(design, touchesOf(design), mesh), stop));
  if (problem.findFactor(threads, stop) == 0) return {};
  const auto surfaces = InfluenceSurfaces::find(problem, readings, threads, stop);
  if (!surfaces) return {};
  SampleBounds bounds;
  const std::vector<TouchInfluence> influences = surfaces->of(touches, threads, stop);
  const auto sizes_mm = samples.touches.row(kTouchSize_mm);
  const bool vary = sizes_mm.minCoeff() < sizes_mm.maxCoeff();
  std::vector<TouchInfluence> larger, smaller;
  if (vary) {
    larger = surfaces->of(resized(touches, 1 + kSizeStep), threads, stop);
    smaller = surfaces->of(resized(touches, 1 - kSizeStep), threads, stop);
  }
  for (std::size_t i = 0; i < touches.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double Fz_N = samples.forces_N(2, column);
    const bool held = samples.touches(kTouchFriction, column) > 0;
    bounds.known.push_back(touchDeviations(influences[i], Fz_N, held, relativeNoise));
    if (!vary) continue;
    const Eigen::VectorXd bySize =
        Fz_N / (2 * kSizeStep) * (larger[i].perNewton.col(2) - smaller[i].perNewton.col(2)); // of its logarithm
    bounds.sizeUnknown.push_back(touchDeviations(influences[i], Fz_N, held, relativeNoise, bySize));
  }
  return bounds;
}

std::vector<TouchDeviations> learnedBounds(const Decoder& decoder, const SampleSet& samples, double relativeNoise,
                                           const std::stop_token& stop) {
  const auto* model = std::get_if<KernelForwardModel>(&decoder.model);
  if (model == nullptr || model->parameters() != kTouchParameters || decoder.correction || !samples.hasTouches())
    return {};
  const double counted = std::max(decoder.noise, leastTouchNoise); // that the components are in
  const std::vector<Eigen::Index> varied = model->varied();
  std::vector<TouchDeviations> bounds;
  for (Eigen::Index i = 0; i < samples.size(); ++i) {
    if (stop.stop_requested()) return {};
    Eigen::VectorXd parameters(kTouchParameters);
    parameters << samples.forces_N.col(i), samples.touches.col(i).segment<2>(kTouchX_mm),
        samples.touches(kTouchSize_mm, i), samples.touches(kTouchFriction, i);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(parameters.size());
    all(varied) = leastDeviations(counted / relativeNoise * model->slopes(parameters)(Eigen::all, varied));
    bounds.push_back({all.head<3>(), all.segment<2>(3)});
  }
  return bounds;
}

ErrorsOverBounds errorsOverBounds(const std::vector<TouchDeviations>& bounds,
                                  const Eigen::Ref<const Eigen::MatrixXd>& forceErrors_N,
                                  const Eigen::Ref<const Eigen::MatrixXd>& placeErrors_mm) {
  std::vector<double> force, place, forceRatio, placeRatio;
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    force.push_back(bounds[i].force_N.z());
    place.push_back(bounds[i].place_mm.norm());
    forceRatio.push_back(std::abs(forceErrors_N(2, column)) / (kMedianOfNormal * force.back()));
    placeRatio.push_back(placeErrors_mm.col(column).norm() / (kMedianOfRayleigh / std::sqrt(2) * place.back()));
  }
  return {median(force), median(place), median(forceRatio), median(placeRatio)};
}

} // namespace palp
