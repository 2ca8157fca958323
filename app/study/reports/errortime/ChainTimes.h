#pragma once

#include "app/study/reports/Report.h"
#include "app/study/reports/Timing.h"
#include "app/study/reports/networks/NetworkCheck.h"

#include <optional>
#include <string>
#include <vector>

namespace palp {

/// A network or another decoder: error against the seconds of training and of predicting.
struct DecoderTimes {
  std::string input; ///< clean displacements, or resistances with noise
  std::string what;
  Timing training;                 ///< [s]
  Timing prediction;               ///< [us] a sample
  double error_percentOfRange = 0; ///< root mean square of the three forces
  std::string failed;
};

/// A chain to the force from scratch: mesh and samples, then training.
struct ChainTimes {
  std::string mesh;
  int perArea = 0;
  double prepare_s = 0, sample_s = 0, train_s = 0; ///< mesh and factorisation; samples; network
  double error_percentOfRange = 0;                 ///< against samples of a finer mesh
  std::string failed;

  [[nodiscard]] double total_s() const { return prepare_s + sample_s + train_s; }
};

/// Full solves against surrogate samples.
struct SampleTimes {
  std::string what;
  int samples = 0;
  double seconds = 0; ///< with mesh and factorisation
  double error = 0;   ///< relative, of the electrode displacements, measured against full Newton
};

std::vector<DecoderTimes> decoderTimes(const ReportRequest& request, const TwoSets& sets, StageLog& stages,
                                       const ReportProgress& progress, const std::stop_token& stop);
/// Seconds of the leave-one-out errors of kLeaveOneOutSpreads spreads together, from the clean displacements of the
/// centre row-wire.
inline constexpr int kLeaveOneOutSpreads = 40;
Timing leaveOneOutTimes(const ReportRequest& request, const TwoSets& sets, const std::stop_token& stop);
/// Size of the mesh whose samples chains are tested on, for the paper's block (MeshShare.h).
inline constexpr double kReferenceSize_mm = 3;
/// Trained on samples of several meshes and counts, tested on others of the reference mesh.
std::vector<ChainTimes> chainTimes(const ReportRequest& request, StageLog& stages, const ReportProgress& progress,
                                   const std::stop_token& stop);
std::vector<SampleTimes> sampleTimes(const ReportRequest& request, StageLog& stages, const ReportProgress& progress,
                                     const std::stop_token& stop);

} // namespace palp
