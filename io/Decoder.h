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

/// Step 1 under the conduction field, to first order: the changes of ln R of the read row-wires are linear in the
/// forces on the areas; this relation, solved for the forces, and the displacements under these forces.
struct BlockInversion {
  Eigen::VectorXd rest_ohm;       ///< of the readings
  Eigen::MatrixXd forces_N;       ///< forces x readings: forces per change of ln R from rest
  Eigen::MatrixXd modes_mm_per_N; ///< (3 x electrodes of the rows) x forces: displacements per force

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

/// Training range of the position along x and y, and its rms error found in training.
struct DecoderPlace {
  Eigen::VectorXd low_mm, high_mm, residual_mm;
};

/// Correction of a decoder's output that labelled frames of a board determined: gains * output + offset, for the forces
/// [N] and below them the position [mm].
struct OutputCorrection {
  Eigen::MatrixXd gains;
  Eigen::VectorXd offset;
};

/// Inputs of a decoder: their kind, row-wires and range in training.
struct DecoderInput {
  InputKind kind = InputKind::Displacement;
  std::vector<int> rows;
  int rowWires = 0;          ///< of the design
  int valuesPerRow = 0;      ///< 3 x electrodes of a row-wire, or column-wires
  Eigen::VectorXd low, high; ///< training range of each input [mm or ohm]
};

/// Part of a decoder that was trained on measured rows: its input stage, and its errors on rows left out, as estimates
/// for later rows (resources/docs/numerics/measured.md). Outputs are the forces, and below them the position.
struct MeasuredTraining {
  InputStage stage;
  DeviationLaw deviation;
  TrainingEllipse ellipse;
  RowDependence dependence;
  Eigen::VectorXd stated;                   ///< rms error of each output on rows left out
  Eigen::VectorXd singleRows;               ///< the same with single rows left out
  std::optional<Eigen::VectorXd> recording; ///< the same with a complete run left out
  double relative = 0;                      ///< rms over the outputs of stated / standard deviation
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
  std::optional<Readout> readout; ///< of the resistances it was trained on; nullopt: Eq. (1), or unknown
  std::string trainedWith;        ///< the command that reproduces it
  DecoderMode mode = DecoderMode::Default;
  std::uint64_t seed = 1;
  double noise = 0; ///< relative noise of the inputs it was trained with
  int areaCount = 0;
  bool together = false;             ///< gives one force for each area at the same time: 3 x areas outputs
  std::string touches;               ///< the indenters it was trained on, as text; empty: forces on complete areas
  std::optional<DecoderPlace> place; ///< for force and position: the model outputs x and y after the force
  /// Calibration of a decoder by inversion or of measured rows, whose model is left unchanged; nullopt: not calibrated.
  std::optional<OutputCorrection> correction;
  Eigen::VectorXd low_N, high_N;            ///< training range of each force
  Eigen::MatrixXd residual_N;               ///< forces x areas (1 where unknown): rms error found in training, per area
  std::optional<ForwardModel> areas;        ///< determines the touched area; nullopt for `together` or with one area
  std::vector<int> areaOfClass;             ///< area of each class of `areas` (or of the maximum likelihood decoder)
  FitReport report;                         ///< of the fit; errors in N
  std::optional<MeasuredTraining> measured; ///< if set, the model takes the inputs of its stage

  /// Number of force components.
  [[nodiscard]] Eigen::Index outputs() const { return low_N.size(); }
  [[nodiscard]] Eigen::Index inputs() const { return input.low.size(); }
  /// Number of a model's answers: the forces, and below them x and y of a place.
  [[nodiscard]] Eigen::Index answers() const { return outputs() + (place ? 2 : 0); }
};

/// Whether a calibration is kept in `correction`; that of other decoders changes their model.
inline bool keepsCorrection(const Decoder& decoder) {
  return decoder.measured.has_value() || std::holds_alternative<KernelForwardModel>(decoder.model);
}

} // namespace palp
