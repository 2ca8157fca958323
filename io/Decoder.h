#pragma once

#include "io/DecoderKind.h"
#include "model/SensorDesign.h"
#include "nn/RbfNetwork.h"
#include "nn/RbfTrainer.h"
#include "nn/baselines/BackPropagation.h"
#include "nn/baselines/ForwardModel.h"
#include "nn/baselines/GaussianProcess.h"
#include "nn/baselines/PolynomialRidge.h"
#include "nn/inversion/KernelInversion.h"
#include "nn/measured/MeasuredFit.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace palp {

/// Step 1 under the law of the field: the resistances at rest, and how those of the read row-wires follow the block's
/// answer to forces on its areas, solved for these forces, to first order.
struct BlockInversion {
  Eigen::VectorXd rest_ohm;       ///< readings
  Eigen::MatrixXd forces_N;       ///< forces x readings: of ln R / R at rest
  Eigen::MatrixXd modes_mm_per_N; ///< (3 electrodes of the rows) x forces

  /// Displacements [mm] from resistances [ohm], one column per sample.
  [[nodiscard]] Eigen::MatrixXd displacements_mm(const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm) const {
    const Eigen::MatrixXd change = (rest_ohm.cwiseInverse().asDiagonal() * resistances_ohm).array().log();
    return modes_mm_per_N * (forces_N * change);
  }
};

/// The paper's two steps: step 1, resistances -> displacements of the row-wires' electrodes; step 2,
/// displacements -> force.
struct TwoStep {
  std::optional<BackPropagationNetwork> network; ///< step 1 as in the paper's reference [12]
  std::optional<SensorDesign> design;            ///< step 1 by inverting Eq. (1) of this design
  std::optional<BlockInversion> block;           ///< step 1 under the law of the field
  std::vector<int> rows;
  RbfNetwork force; ///< step 2
};

/// Along x and y: training range of the place, and the rms error of it that was found in training.
struct DecoderPlace {
  Eigen::VectorXd low_mm, high_mm, residual_mm;
};

/// What labelled frames of a board made of a decoder's answer: gains * answer + offset, the forces [N] and below them
/// the place [mm].
struct OutputCorrection {
  Eigen::MatrixXd gains;
  Eigen::VectorXd offset;
};

/// What a decoder reads: kind and row-wires, and their range in training.
struct DecoderInput {
  InputKind kind = InputKind::Displacement;
  std::vector<int> rows;
  int rowWires = 0;          ///< of the design
  int valuesPerRow = 0;      ///< 3 electrodes or column-wires
  Eigen::VectorXd low, high; ///< training range of each input [mm or ohm]
};

/// Of a decoder that was trained with measured rows: what it makes of the readings, and the errors that leaving out
/// rows found, which hold for later rows (resources/docs/numerics/measured.md). Outputs are the forces, and below them
/// the position.
struct MeasuredTraining {
  InputStage stage;
  DeviationLaw deviation;
  TrainingEllipse ellipse;
  RowDependence dependence;
  Eigen::VectorXd stated;                   ///< rms error of each output
  Eigen::VectorXd singleRows;               ///< what leaving out single rows would have stated
  std::optional<Eigen::VectorXd> recording; ///< with a complete recording left out
  double relative = 0;                      ///< stated error, of the forces' deviations
  std::optional<double> relativeRecording;
};

/// A trained map from the sensor's readings to the force, with everything needed to use and to judge it.
struct Decoder {
  DecoderKind kind = DecoderKind::Rbf;
  std::variant<RbfNetwork, PolynomialRidge, GaussianProcess, BackPropagationNetwork, TwoStep, ForwardModel,
               KernelForwardModel>
      model;
  DecoderInput input;
  std::string designFingerprint;
  std::optional<Readout> readout; ///< of the resistances it was trained on; none: Eq. (1), or not known
  std::string trainedWith;        ///< the command that reproduces it
  DecoderMode mode = DecoderMode::Default;
  std::uint64_t seed = 1;
  double noise = 0; ///< relative noise of the inputs it was trained with
  int areaCount = 0;
  bool together = false;             ///< one force per area together: 3 x areas outputs
  std::string touches;               ///< the indenters it was trained on, as text; empty: forces on complete areas
  std::optional<DecoderPlace> place; ///< of a decoder of force and position, whose model gives x and y after the force
  /// Of a decoder by inversion, whose model of the readings stays as it is; none: not calibrated.
  std::optional<OutputCorrection> correction;
  Eigen::VectorXd low_N, high_N;            ///< training range of each force
  Eigen::MatrixXd residual_N;               ///< forces x areas (1 where unknown): rms error found in training, per area
  std::optional<ForwardModel> areas;        ///< finds the touched area; none for `together` or where there is one area
  std::vector<int> areaOfClass;             ///< area of each class of `areas` (or of the maximum likelihood decoder)
  FitReport report;                         ///< of the fit; sizes in N
  std::optional<MeasuredTraining> measured; ///< the model reads the stage's inputs

  /// Components of the forces.
  [[nodiscard]] Eigen::Index outputs() const { return low_N.size(); }
  [[nodiscard]] Eigen::Index inputs() const { return input.low.size(); }
};

} // namespace palp
