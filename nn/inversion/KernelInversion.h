#pragma once

#include "nn/RbfNetwork.h"
#include "nn/inversion/SplineTable.h"

#include <Eigen/Core>

#include <functional>
#include <stop_token>
#include <utility>
#include <vector>

namespace palp {

/// Smallest relative noise that components are scaled by, used where the decoder is trained with less or none: the
/// error that the solver's own tolerance leaves.
inline constexpr double leastTouchNoise = 1e-6;

/// From this number of samples on, the samples resolve shorter lengths and a finer table pays off.
inline constexpr Eigen::Index manyTouchSamples = 2000;

/// Forward model of touches: many measurements as a smooth function of a few parameters, some of which are coordinates
/// of a position, over which measurements rise and fall (ForwardModel's polynomials cannot follow that). The
/// measurements are projected onto the principal components that exceed the noise; each component is fitted by
/// Gaussians over the positions times monomials in the other parameters and stored as a table. Files before 1.0.0
/// contain a network of Gaussians instead. Where to read more: resources/docs/numerics/touch-decoder.md.
struct KernelForwardModel {
  Eigen::VectorXd parameterOffset,
      parameterFactor;                ///< parameters to the inputs of the table, (y - offset) * factor; 0: never varied
  Eigen::VectorXd parameterDeviation; ///< prior of each parameter: range / sqrt(12), about the offset
  Eigen::VectorXd measurementOffset;
  Eigen::MatrixXd projection; ///< components x measurements: in standard deviations of the noise
  SplineTable table;          ///< scaled parameters that vary -> components; without inputs where there is a network
  RbfNetwork network;         ///< the same, of older files
  Eigen::MatrixXd initialGuesses; ///< scaled parameters of some samples, from which an inversion starts; of a table
  std::vector<int> amplitudes; ///< inputs of the table: if all are 0, the measurements equal those at rest; of a table
  Eigen::VectorXd deviation;   ///< of each component: noise and the model's own error
  Eigen::VectorXd inflation;   ///< of each parameter: error on samples that were held out, over that expected of it
  /// Mean square of the residual, in deviations, that 99 of 100 held-out samples stay below; 0: unknown, in older
  /// files.
  double residualLimit = 0;

  [[nodiscard]] Eigen::Index measurements() const { return measurementOffset.size(); }
  [[nodiscard]] Eigen::Index parameters() const { return parameterOffset.size(); }
  [[nodiscard]] Eigen::Index components() const { return deviation.size(); }
  /// The parameters that have varied: the inputs of the table, in its order.
  [[nodiscard]] std::vector<Eigen::Index> varied() const;
  /// Derivatives of the components by all parameters (components x parameters): of those that never varied 0.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::Ref<const Eigen::VectorXd>& parameters) const;
};

/// A reflection that maps the measured body onto itself: reflected parameters give the same measurements in another
/// order.
struct KernelMirror {
  std::vector<Eigen::Index> measurement; ///< of each: whose value it takes; undoes itself
  std::vector<std::pair<Eigen::Index, double>>
      about; ///< parameters that are reflected, and the value of each that stays
};

struct KernelForwardOptions {
  double relativeNoise = 0; ///< of each measurement
  int threads = 0;          ///< 0: all cores; the result is the same
  /// Prior mean of the measurements at parameters (one column each); only the difference from it is learned. Null:
  /// none.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& parameters)> priorMean = {};
  /// Of the body; they commute. Each doubles the information of a sample.
  std::vector<KernelMirror> mirrors = {};
};

struct KernelForwardFit {
  KernelForwardModel model;
  std::vector<Eigen::Index> heldOut; ///< every fifth sample: inverted by a model of the others
  Eigen::MatrixXd heldOutResiduals;  ///< parameters x these: true less estimated
  double width = 0;                  ///< of the Gaussians over the places
};

/// Fits the model; one column per sample. Parameters of group 0 are coordinates of the position, at most two of which
/// vary; those of group 1 are amplitudes: if all of them are 0, the measurements do not depend on the others. The width
/// of the Gaussians, the decay of the monomials and the samples' own noise are chosen by leave-one-out. Throws
/// NetworkError where nothing can be fitted, and Cancelled.
KernelForwardFit fitKernelForwardModel(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                                       const Eigen::Ref<const Eigen::MatrixXd>& parameters,
                                       const Eigen::VectorXi& groups, const KernelForwardOptions& options,
                                       const std::stop_token& stop = {});

/// Parameters of one measurement vector.
struct KernelEstimate {
  Eigen::VectorXd parameters;
  Eigen::VectorXd standardDeviation;
  double chiSquare = 0; ///< mean square of the residual, in standard deviations: 1 if model and noise fit
  double change = 0;    ///< mean square of the change from rest, in deviations of the noise; 0 where rest is unknown
};

/// Maximum a posteriori estimate of the parameters by Gauss-Newton steps with Levenberg's damping, started from the
/// most likely of the model's initial guesses; each parameter has a normal prior with the variance of its range. Keeps
/// what all inversions share. The model must outlive it.
class KernelInversion {
public:
  explicit KernelInversion(const KernelForwardModel& model);
  [[nodiscard]] KernelEstimate estimate(const Eigen::Ref<const Eigen::VectorXd>& measurement) const;
  /// Whether the model has this parameter and it varied in the samples.
  [[nodiscard]] bool finds(Eigen::Index parameter) const {
    return parameter < model_.parameters() && model_.parameterFactor(parameter) != 0;
  }

private:
  struct Trial;
  /// Components and their derivatives by the scaled parameters.
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& scaled, Eigen::VectorXd& value, Eigen::MatrixXd& slope) const;
  [[nodiscard]] Trial descend(const Eigen::VectorXd& start, const Eigen::VectorXd& wanted) const;
  [[nodiscard]] Trial trialAt(Eigen::VectorXd scaled, const Eigen::VectorXd& wanted) const;
  /// Squared distance between the positions of two initial guesses.
  [[nodiscard]] double squareApart(Eigen::Index start, Eigen::Index other) const;
  [[nodiscard]] std::vector<Eigen::VectorXd> initialGuessesFor(const Eigen::VectorXd& wanted) const;

  const KernelForwardModel& model_;
  SplineReader table_;
  std::vector<Eigen::Index> varied_;
  Eigen::VectorXd weight_;         ///< 1 / deviation
  Eigen::MatrixXd weighted_;       ///< projection in these units
  Eigen::VectorXd precision_;      ///< prior precision of the scaled parameters that vary
  Eigen::MatrixXd initialGuesses_; ///< scaled parameters
  Eigen::MatrixXd expected_;       ///< weighted components there; of a table without those at rest
  Eigen::VectorXd rest_;           ///< weighted, of a table
  Eigen::VectorXd expectedSquare_; ///< of each column
  double spacing_ = 0;             ///< initial guesses nearer than this mostly lead to the same parameters; of a table
};

} // namespace palp
