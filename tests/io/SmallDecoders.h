#pragma once

#include "io/Decoder.h"
#include "nn/linear/RandomNumbers.h"

#include <string>
#include <vector>

namespace palp {

/// Smooth samples of a row-wire with three inputs around 100 ohm, and the forces that caused them.
struct SmallSamples {
  Eigen::MatrixXd inputs = Eigen::MatrixXd(3, 12), forces = Eigen::MatrixXd(3, 12);
  Eigen::VectorXi areas = Eigen::VectorXi(12);

  SmallSamples() {
    RandomNumbers random(1);
    for (Eigen::Index i = 0; i < 12; ++i) {
      areas(i) = static_cast<int>(i % 2);
      forces.col(i) << 2 * random.uniform() - 1, 2 * random.uniform() - 1, -6 * random.uniform();
      const Eigen::Vector3d f = forces.col(i);
      inputs.col(i) << 100 + f.x() + f.z() / 6, 100 + f.y() - f.z() / 6, 100 + f.z() + 0.1 * f.x() * f.x();
      inputs.col(i).array() += 3 * areas(i);
    }
  }
};

/// A design of two row-wires with one electrode each and three column-wires, so that Eq. (1) can be inverted.
inline SensorDesign squareDesign() {
  SensorDesign design = paperDesign();
  design.areas = {2, 1};
  design.upper = {{10, 20}, {{15}}, {{4}}};
  design.lower = {{5, 15, 25}, {{10, 20}}, {{1}}};
  return design;
}

/// What all small decoders have in common: they read row-wire 1 of 2.
inline Decoder emptyDecoder(DecoderKind kind, const SmallSamples& samples) {
  Decoder decoder;
  decoder.kind = kind;
  decoder.input = {
      InputKind::Resistance, {1}, 2, 3, samples.inputs.rowwise().minCoeff(), samples.inputs.rowwise().maxCoeff()};
  decoder.designFingerprint = "0123456789abcdef";
  decoder.trainedWith = "palp train --decoder " + name(kind);
  decoder.areaCount = 2;
  decoder.low_N = samples.forces.rowwise().minCoeff();
  decoder.high_N = samples.forces.rowwise().maxCoeff();
  decoder.residual_N = Eigen::MatrixXd::Ones(3, 2);
  return decoder;
}

inline Decoder smallDecoder(DecoderKind kind) {
  const SmallSamples samples;
  Decoder decoder = emptyDecoder(kind, samples);
  const auto areas = [&] {
    ForwardModelOptions options;
    options.degree = 1;
    options.relativeNoise = 1e-4;
    return fitForwardModel(samples.inputs, samples.forces, samples.areas, options);
  };
  RbfOptions rbf;
  rbf.tail = Tail::Bias;
  rbf.spread = 1;
  BackPropagationOptions backPropagation;
  backPropagation.hidden = 4;
  backPropagation.iterations = 20;
  PolynomialOptions polynomial;
  decoder.areas = areas();
  decoder.areaOfClass = {0, 1};
  switch (kind) {
  case DecoderKind::Rbf: {
    RbfFit fit = trainRbf(samples.inputs, samples.forces, rbf);
    decoder.model = fit.network;
    decoder.report = std::move(fit.report);
    break;
  }
  case DecoderKind::Linear:
  case DecoderKind::Polynomial2:
  case DecoderKind::Polynomial3:
    polynomial.degree = kind == DecoderKind::Linear ? 1 : kind == DecoderKind::Polynomial2 ? 2 : 3;
    decoder.model = trainPolynomial(samples.inputs, samples.forces, polynomial).model;
    break;
  case DecoderKind::GaussianProcess:
    decoder.model = trainGaussianProcess(samples.inputs, samples.forces).process;
    break;
  case DecoderKind::BackPropagation:
    decoder.model = trainBackPropagation(samples.inputs, samples.forces, backPropagation).network;
    break;
  case DecoderKind::TwoStepBackPropagation:
  case DecoderKind::TwoStepGaussNewton: {
    const Eigen::MatrixXd displacements = (samples.inputs.array() - 100) / 100;
    TwoStep twoStep;
    twoStep.rows = {1};
    twoStep.force = trainRbf(displacements, samples.forces, rbf).network;
    if (kind == DecoderKind::TwoStepGaussNewton)
      twoStep.design = squareDesign();
    else
      twoStep.network = trainBackPropagation(samples.inputs, displacements, backPropagation).network;
    decoder.model = std::move(twoStep);
    break;
  }
  case DecoderKind::MaximumLikelihood:
    decoder.model = areas();
    decoder.areas.reset();
    break;
  case DecoderKind::TouchInversion: {
    Eigen::MatrixXd parameters(7, 12); // forces, a place, a size and a friction
    parameters << samples.forces, samples.inputs.topRows<2>(), samples.inputs.row(2), Eigen::RowVectorXd::Zero(12);
    const Eigen::VectorXi groups = (Eigen::VectorXi(7) << 1, 1, 1, 0, 0, 2, 2).finished();
    decoder.model = fitKernelForwardModel(samples.inputs, parameters, groups, {1e-4, 1}).model;
    decoder.place = DecoderPlace{Eigen::Vector2d(98, 98), Eigen::Vector2d(105, 105), Eigen::Vector2d(0.1, 0.2)};
    decoder.touches = "sphere:3..6@3,3,27,27 press 0.5..6";
    decoder.areas.reset();
    decoder.areaOfClass.clear();
    break;
  }
  }
  return decoder;
}

/// An rbf decoder whose scaler rotates three inputs to two.
inline Decoder whitenedDecoder() {
  const SmallSamples samples;
  Decoder decoder = smallDecoder(DecoderKind::Rbf);
  RbfOptions options;
  options.scaling = Scaling::Whiten;
  options.relativeInputNoise = 0.05; // the weakest component drowns in it
  options.spread = 1;
  decoder.model = trainRbf(samples.inputs, samples.forces, options).network;
  return decoder;
}

/// A two-step decoder whose first step inverts the field.
inline Decoder fieldTwoStepDecoder() {
  const SmallSamples samples;
  Decoder decoder = smallDecoder(DecoderKind::TwoStepGaussNewton);
  TwoStep& twoStep = std::get<TwoStep>(decoder.model);
  twoStep.design.reset();
  twoStep.block = {Eigen::Vector3d::Constant(100), 0.1 * Eigen::MatrixXd::Identity(3, 3),
                   Eigen::MatrixXd::Identity(3, 3)};
  return decoder;
}

/// One force an area, both at once.
inline Decoder togetherDecoder() {
  const SmallSamples samples;
  Decoder decoder = emptyDecoder(DecoderKind::Linear, samples);
  Eigen::MatrixXd both(6, 12);
  both << samples.forces, samples.forces.rowwise().reverse();
  decoder.together = true;
  decoder.model = trainPolynomial(samples.inputs, both).model;
  decoder.low_N = both.rowwise().minCoeff();
  decoder.high_N = both.rowwise().maxCoeff();
  decoder.residual_N = Eigen::MatrixXd::Ones(6, 1);
  return decoder;
}

} // namespace palp
