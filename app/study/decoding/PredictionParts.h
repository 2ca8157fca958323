#pragma once

#include "app/study/decoding/FewerReadings.h"
#include "app/study/decoding/Prediction.h"

namespace palp {

// What Predictor and PartialPredictor share.

/// Variance of noise beyond the training's, in that of the noise that the components of touches are counted in.
double noiseBeyond(const Decoder& decoder, const PredictOptions& options);
/// The model with the noise that the options say.
ForwardModel withNoise(ForwardModel model, const Decoder& decoder, const PredictOptions& options);
KernelForwardModel withNoise(KernelForwardModel model, const Decoder& decoder, const PredictOptions& options);
/// dF/dx at an input.
Eigen::MatrixXd slopeAt(const Decoder& decoder, const Eigen::VectorXd& input);
/// Area and likelihood of the most likely touch.
void addAreas(const Decoder& decoder, const LikelihoodInversion& inversion,
              const Eigen::Ref<const Eigen::MatrixXd>& inputs, Prediction& result);
/// Forces and places with their deviations, and how well the model explains the inputs; of some readings where `fewer`
/// is given.
void decodeTouches(const Decoder& decoder, const KernelForwardModel& model, const KernelInversion& inversion,
                   const FewerTouchReadings* fewer, const Eigen::Ref<const Eigen::MatrixXd>& inputs,
                   const PredictOptions& options, Prediction& result);
/// What a calibration made of forces and places and left in their deviations; the places apart from the forces.
void finish(const Decoder& decoder, Prediction& result);

} // namespace palp
