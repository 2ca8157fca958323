#pragma once

#include "app/study/decoding/TrainOptions.h"
#include "io/Decoder.h"
#include "model/SampleSet.h"

#include <Eigen/Core>

#include <functional>
#include <stop_token>

namespace palp {

/// One row-wire's inversion of Eq. (1).
struct Inversion {
  Eigen::MatrixXd displacements_mm; ///< (3 electrodes) x samples
  double condition = 0;             ///< of d ln R / d u at rest
  int rank = 0;
  int worstIterations = 0;
  double worstResidual = 0; ///< largest |R - R(u)| / R left
};

/// Displacements of a row-wire's electrodes whose Eq. (1) gives the resistances [ohm] (column-wires x samples), by
/// damped Gauss-Newton from rest, the step of smallest norm where the system is singular. Throws Error where the system
/// is not square and where lower electrodes or resistivity follow the rubber, for then u alone does not decide R.
Inversion invertRowResistances(const SensorDesign& design, int rowWire,
                               const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm,
                               const std::stop_token& stop = {});

/// Step 1 alone: displacements [mm] of all rows, rows stacked, from their resistances, rows stacked.
Eigen::MatrixXd displacementsOf(const TwoStep& decoder, const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm);
/// Both steps.
Eigen::MatrixXd predict(const TwoStep& decoder, const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm);

struct TwoStepFit {
  TwoStep decoder;
  FitReport report;
  Eigen::MatrixXd residuals_N; ///< outputs x samples: of both steps on the training samples, with the noise
};

/// Step 1 by Gauss-Newton where a design is given (under the field one step of it from rest), else by a
/// back-propagation network; step 2 a network trained on what step 1 gives. Throws Error unless the input is
/// resistance.
TwoStepFit trainTwoStep(const SampleSet& samples, const SensorDesign* design, const DecoderInput& input,
                        const TrainOptions& options, const std::stop_token& stop,
                        const std::function<void(double, const std::string&)>& progress);

/// Forces of the maximum likelihood decoder on the samples with the options' noise.
Eigen::MatrixXd likelihoodForces(const ForwardModel& model, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                                 const TrainOptions& options, const std::stop_token& stop);

} // namespace palp
