#pragma once

#include "model/SensorDesign.h"
#include "nn/RbfNetwork.h"
#include "nn/RbfTrainer.h"
#include "nn/rivals/BackPropagation.h"
#include "nn/rivals/ForwardModel.h"
#include "nn/rivals/GaussianProcess.h"
#include "nn/rivals/PolynomialRidge.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace palp {

/// What a decoder reads.
enum class InputKind { Displacement, Resistance };
/// displacement, resistance.
std::string name(InputKind kind);
InputKind inputKindNamed(const std::string& name);

/// Kinds of decoders, as on the command line: rbf, linear, poly2, poly3, gp, bp, two-step-bp,
/// two-step-gn, ml.
enum class DecoderKind {
  Rbf,
  Linear,
  Polynomial2,
  Polynomial3,
  GaussianProcess,
  BackPropagation,
  TwoStepBackPropagation, ///< the paper's step 1 by a back-propagation network (its reference [12]), then step 2
  TwoStepGaussNewton,     ///< step 1 by inverting Eq. (1), then step 2
  MaximumLikelihood,      ///< inverts a polynomial forward model: area and force at once
};
std::string name(DecoderKind kind);
DecoderKind decoderKindNamed(const std::string& name);
std::vector<DecoderKind> allDecoderKinds();

/// The two modes of a network; any other option overrides the mode.
enum class DecoderMode { Default, Paper };
std::string name(DecoderMode mode);
DecoderMode decoderModeNamed(const std::string& name);

/// The paper's two steps: step 1, resistances -> displacements of the row-wires' electrodes; step 2,
/// displacements -> force.
struct TwoStep {
  std::optional<BackPropagationNetwork> network; ///< step 1 as in the paper's reference [12]
  std::optional<SensorDesign> design;            ///< step 1 by inverting Eq. (1) of this design
  std::vector<int> rows;
  RbfNetwork force; ///< step 2
};

/// What a decoder reads: kind and row-wires, and their range in training.
struct DecoderInput {
  InputKind kind = InputKind::Displacement;
  std::vector<int> rows;
  int rowWires = 0;          ///< of the design
  int valuesPerRow = 0;      ///< 3 electrodes or column-wires
  Eigen::VectorXd low, high; ///< training range of each input [mm or ohm]
};

/// A trained map from the sensor's readings to the force, with everything needed to use and to judge it.
struct Decoder {
  DecoderKind kind = DecoderKind::Rbf;
  std::variant<RbfNetwork, PolynomialRidge, GaussianProcess, BackPropagationNetwork, TwoStep, ForwardModel> model;
  DecoderInput input;
  std::string designFingerprint;
  std::string trainedWith; ///< the command that reproduces it
  DecoderMode mode = DecoderMode::Default;
  std::uint64_t seed = 1;
  double noise = 0; ///< relative noise of the inputs it was trained with
  int areaCount = 0;
  bool together = false;             ///< one force per area at once: 3 x areas outputs
  Eigen::VectorXd low_N, high_N;     ///< training range of each output
  Eigen::MatrixXd residual_N;        ///< outputs x areas (1 where unknown): rms error found in training, per area
  std::optional<ForwardModel> areas; ///< tells which area is touched; none for `together` or a single area
  std::vector<int> areaOfClass;      ///< area of each class of `areas` (or of the maximum likelihood decoder)
  FitReport report;                  ///< of the fit; sizes in N

  [[nodiscard]] Eigen::Index outputs() const { return low_N.size(); }
  [[nodiscard]] Eigen::Index inputs() const { return input.low.size(); }
};

} // namespace palp
