#pragma once

#include "nn/RbfNetwork.h"
#include "nn/rivals/SplineTable.h"

#include <Eigen/Core>

#include <functional>
#include <stop_token>
#include <utility>
#include <vector>

namespace palp {

/// Relative noise that components are counted in, where less or none is trained for: what the solver's own tolerance
/// leaves.
inline constexpr double leastTouchNoise = 1e-6;

/// So many samples or more know of shorter ways than fewer do: finer means pay for themselves.
inline constexpr Eigen::Index manyTouchSamples = 2000;

/// Many measurements as a smooth function of a few causes: what the polynomials of ForwardModel are where the causes
/// include a place, over which measurements rise and fall. The measurements are taken together into those components
/// that stand out of the noise. Fitted by Gaussians over the places and monomials in the other causes, kept as a
/// table; files before 1.0.0 hold a network of Gaussians in its place.
struct KernelForwardModel {
  Eigen::VectorXd causeOffset,
      causeFactor;                ///< causes to the inputs of the table, (y - offset) * factor; 0: never varied
  Eigen::VectorXd causeDeviation; ///< known beforehand of each cause: range / sqrt(12), about the offset
  Eigen::VectorXd measurementOffset;
  Eigen::MatrixXd projection; ///< components x measurements: in standard deviations of the noise
  SplineTable table;          ///< scaled causes that vary -> components; without inputs where there is a network
  RbfNetwork network;         ///< the same, of older files
  Eigen::MatrixXd starts;     ///< scaled causes of some samples, from which an inversion begins; of a table
  std::vector<int> strengths; ///< scaled causes without which the measurements rest, all of them 0; of a table
  Eigen::VectorXd deviation;  ///< of each component: noise and the model's own error
  Eigen::VectorXd inflation;  ///< of each cause: error on samples that were held out, over that expected of it
  /// Mean square of what is left, in deviations, that 99 of 100 samples that were held out stay below; 0: not known, in
  /// older files.
  double leftByOne = 0;

  [[nodiscard]] Eigen::Index measurements() const { return measurementOffset.size(); }
  [[nodiscard]] Eigen::Index causes() const { return causeOffset.size(); }
  [[nodiscard]] Eigen::Index components() const { return deviation.size(); }
  /// The causes that have varied: the inputs of the table, in its order.
  [[nodiscard]] std::vector<Eigen::Index> varied() const;
  /// Derivatives of the components by all causes (components x causes): of those that never varied 0.
  [[nodiscard]] Eigen::MatrixXd slopes(const Eigen::Ref<const Eigen::VectorXd>& causes) const;
};

/// A reflection under which the measured body is its own image: where the causes are reflected, the measurements are
/// the same in another order.
struct KernelMirror {
  std::vector<Eigen::Index> measurement;              ///< of each: whose value it takes; undoes itself
  std::vector<std::pair<Eigen::Index, double>> about; ///< causes that are reflected, and the value of each that stays
};

struct KernelForwardOptions {
  double relativeNoise = 0; ///< of each measurement
  int threads = 0;          ///< 0: all cores; the result is the same
  /// What is known beforehand of the measurements at causes (one column each): only the rest is learned. Null: nothing.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd& causes)> known = {};
  /// Of the body; they commute. Each doubles what is learned from a sample.
  std::vector<KernelMirror> mirrors = {};
};

struct KernelForwardFit {
  KernelForwardModel model;
  std::vector<Eigen::Index> heldOut; ///< every fifth sample: inverted by a model of the others
  Eigen::MatrixXd heldOutResiduals;  ///< causes x these: true less estimated
  double width = 0;                  ///< of the Gaussians over the places
};

/// One column a sample. Causes of group 0 are places, at most two of which vary; those of group 1 strengths: where all
/// of them are 0, the measurements are the same whatever the others. Width of the Gaussians, reach of the monomials
/// and what the samples' own noise is are chosen by leave-one-out. Throws NetworkError where nothing can be fitted, and
/// Cancelled.
KernelForwardFit fitKernelForwardModel(const Eigen::Ref<const Eigen::MatrixXd>& measurements,
                                       const Eigen::Ref<const Eigen::MatrixXd>& causes, const Eigen::VectorXi& groups,
                                       const KernelForwardOptions& options, const std::stop_token& stop = {});

/// Causes of one measurement vector.
struct KernelEstimate {
  Eigen::VectorXd causes;
  Eigen::VectorXd standardDeviation;
  double chiSquare = 0; ///< mean square of what is left, in standard deviations: 1 if model and noise fit
  double change = 0;    ///< mean square of the change from rest, in deviations of the noise; 0 where rest is not known
};

/// Maximum a posteriori by Gauss-Newton steps (Levenberg's damping) from the most likely of the samples kept for it,
/// each cause normal with the variance of its range; keeps what inverting many has in common. The model must outlive
/// it.
class KernelInversion {
public:
  explicit KernelInversion(const KernelForwardModel& model);
  [[nodiscard]] KernelEstimate estimate(const Eigen::Ref<const Eigen::VectorXd>& measurement) const;
  /// Whether this cause is one of the model and has varied.
  [[nodiscard]] bool finds(Eigen::Index cause) const {
    return cause < model_.causes() && model_.causeFactor(cause) != 0;
  }

private:
  struct Trial;
  /// Components and their derivatives by the scaled causes.
  void evaluate(const Eigen::Ref<const Eigen::VectorXd>& scaled, Eigen::VectorXd& value, Eigen::MatrixXd& slope) const;
  [[nodiscard]] Trial descend(const Eigen::VectorXd& start, const Eigen::VectorXd& wanted) const;
  [[nodiscard]] Trial trialAt(Eigen::VectorXd scaled, const Eigen::VectorXd& wanted) const;
  /// Of the places of two starts.
  [[nodiscard]] double squareApart(Eigen::Index start, Eigen::Index other) const;
  [[nodiscard]] std::vector<Eigen::VectorXd> startsFor(const Eigen::VectorXd& wanted) const;

  const KernelForwardModel& model_;
  SplineReader table_;
  std::vector<Eigen::Index> varied_;
  Eigen::VectorXd weight_;         ///< 1 / deviation
  Eigen::MatrixXd weighted_;       ///< projection in these units
  Eigen::VectorXd precision_;      ///< of the scaled causes that vary, known beforehand
  Eigen::MatrixXd starts_;         ///< scaled causes
  Eigen::MatrixXd expected_;       ///< weighted components there; of a table what the strengths make of them
  Eigen::VectorXd rest_;           ///< weighted, of a table
  Eigen::VectorXd expectedSquare_; ///< of each column
  double beside_ = 0; ///< starts whose places are nearer than that lead to the same causes most often; of a table
};

} // namespace palp
