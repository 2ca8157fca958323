#pragma once

#include "app/study/reports/Report.h"
#include "app/study/reports/map/TouchMap.h"
#include "io/Decoder.h"
#include "model/SampleSet.h"
#include "solver/SensorMesh.h"

#include <optional>
#include <stop_token>
#include <vector>

namespace palp {

/// What no estimate without a bias and without prior can beat, at each sample's touch.
struct SampleBounds {
  std::vector<TouchDeviations> known;       ///< with known indenter
  std::vector<TouchDeviations> sizeUnknown; ///< by one who has to find its size as well; empty: all are of one size
  std::vector<TouchDeviations> learned;     ///< of a decoder (learnedBounds), if requested
};

/// `known` and `sizeUnknown`, by the influence surfaces of the design at rest (TouchMap documents what that leaves
/// out), the contact as large as its force makes it. Empty: stopped. Throws Error where the samples are of no touches
/// or of another design, and DesignError where no map can be made.
std::optional<SampleBounds> touchBounds(const SampleSet& samples, const SensorDesign& design, double relativeNoise,
                                        const MeshOptions& mesh, int threads, const std::stop_token& stop = {});

/// The same at each touch as it is and not at rest, by the slopes that a decoder of touches has learned of it, which
/// know of large strains: of one who has to find all that has varied among the samples it learned from. They are those
/// of full solves to 0.2 % in the median (resources/docs/numerics/touch-decoder.md). Empty: a decoder of another
/// kind, or one that was calibrated; or it was stopped.
std::vector<TouchDeviations> learnedBounds(const Decoder& decoder, const SampleSet& samples, double relativeNoise,
                                           const std::stop_token& stop = {});

/// Errors compared with bounds, in the median over the samples: of an estimate that is normal and reaches its bound
/// both ratios are 1.
struct ErrorsOverBounds {
  double force_N = 0, place_mm = 0;      ///< medians of the bounds: of Fz, and of the root of both coordinates' squares
  double forceRatio = 0, placeRatio = 0; ///< of |error of Fz| / (0.6745 bound), distance / its median at the bound
};
ErrorsOverBounds errorsOverBounds(const std::vector<TouchDeviations>& bounds,
                                  const Eigen::Ref<const Eigen::MatrixXd>& forceErrors_N,
                                  const Eigen::Ref<const Eigen::MatrixXd>& placeErrors_mm);

} // namespace palp
