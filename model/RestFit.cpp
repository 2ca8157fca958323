#include "model/RestFit.h"

#include "model/DesignError.h"
#include "model/FieldAtRest.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace palp {

namespace {

constexpr int kMostSteps = 30;
constexpr double kSettled = 1e-6; // last step, in ln of the numbers; far below any deviation
constexpr double kLongestStep = 0.5;
constexpr double kUndetermined = 0.1; // deviation of ln radius
constexpr int kNumbers = 3;           // ln radius, ln resistivity, contact's share of a sphere's own resistance
constexpr int kFewestReadings = 10;   // so that the misfit is meaningful

using Numbers = Eigen::Vector3d;

/// k = contact / (rho a): P = rho (G + (1 + k) / (4 pi a) - 4 pi a^3 S), S = sum grad G' grad G.
FieldLaw lawOf(const Numbers& x, FieldLaw law) {
  law.electrodeRadius_mm = std::exp(x(0));
  law.resistivity_ohm_mm = std::exp(x(1));
  law.contact_ohm_mm2 = x(2) * law.resistivity_ohm_mm * law.electrodeRadius_mm;
  return law;
}

Numbers numbersOf(const FieldLaw& law) {
  return {std::log(law.electrodeRadius_mm), std::log(law.resistivity_ohm_mm),
          law.contact_ohm_mm2 / (law.resistivity_ohm_mm * law.electrodeRadius_mm)};
}

/// One design, its readings, and what of P stays the same.
class RestModel {
public:
  RestModel(const SensorDesign& design, const Eigen::MatrixXd& resistances_ohm, const std::stop_token& stop)
      : stop_(stop), counts_(wireCounts(design)), green_(boxGreen(design.block_mm, electrodes_mm(design))) {
    dipoles_ = Eigen::MatrixXd::Zero(green_.value.rows(), green_.value.cols());
    for (const Eigen::MatrixXd& slope : green_.slope) dipoles_ += slope.transpose() * slope;
    measured_ = resistances_ohm.array().log();
    for (Eigen::Index i = 0; i < measured_.size(); ++i)
      if (!std::isnan(resistances_ohm.data()[i])) known_.push_back(i);
  }

  [[nodiscard]] Eigen::Index readings() const { return static_cast<Eigen::Index>(known_.size()); }

  /// ln R of the sensor less ln R of the model; not finite where there is no such sensor. With the
  /// derivatives of ln R by the numbers on request.
  Eigen::VectorXd left(const FieldLaw& law, const Numbers& x, Eigen::MatrixXd* slopes = nullptr) const {
    throwIfStopped(stop_); // a tenth of a second at most from look to look
    try {
      return leftOf(law, x, slopes);
    } catch (const DesignError&) { // no positive network has these numbers
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      if (slopes) *slopes = Eigen::MatrixXd::Constant(readings(), kNumbers, none);
      return Eigen::VectorXd::Constant(readings(), none);
    }
  }

  [[nodiscard]] Eigen::MatrixXd placed(const Eigen::VectorXd& values) const {
    Eigen::MatrixXd all =
        Eigen::MatrixXd::Constant(measured_.rows(), measured_.cols(), std::numeric_limits<double>::quiet_NaN());
    all.reshaped()(known_) = values;
    return all;
  }

private:
  Eigen::VectorXd leftOf(const FieldLaw& law, const Numbers& x, Eigen::MatrixXd* slopes) const {
    const FieldLaw now = lawOf(x, law);
    const double a = now.electrodeRadius_mm, rho = now.resistivity_ohm_mm;
    const Eigen::MatrixXd p = potentials_ohm(green_, now);
    const TerminalNetwork network(p, counts_, now.wire_ohm);
    const NetworkReading reading(network, now.readout);
    if (slopes) {
      const Eigen::MatrixXd& q = network.currents();
      const double own = rho / (4 * std::numbers::pi * a);
      const Eigen::MatrixXd diagonal = own * (q.transpose() * q);
      const Eigen::MatrixXd dipoles = (12 * std::numbers::pi * a * a * a * rho) * (q.transpose() * dipoles_ * q);
      const std::array<Eigen::MatrixXd, kNumbers> changes{-(1 + x(2)) * diagonal - dipoles, q.transpose() * p * q,
                                                          diagonal};
      slopes->resize(readings(), kNumbers);
      for (int i = 0; i < kNumbers; ++i)
        slopes->col(i) = reading.logChange(network.change(changes[static_cast<std::size_t>(i)])).reshaped()(known_);
    }
    const Eigen::MatrixXd difference = measured_ - reading.resistances_ohm().array().log().matrix();
    return difference.reshaped()(known_);
  }

  const std::stop_token& stop_;
  WireCounts counts_;
  BoxGreen green_;
  Eigen::MatrixXd dipoles_;  ///< S
  Eigen::MatrixXd measured_; ///< ln R
  std::vector<Eigen::Index> known_;
};

/// With the contact kept, k = contact / (rho a) follows the other two.
Eigen::MatrixXd freeSlopes(const Eigen::MatrixXd& slopes, const Numbers& x, int free) {
  Eigen::MatrixXd used = slopes.leftCols(free);
  if (free < kNumbers) used.colwise() -= x(2) * slopes.col(2);
  return used;
}

/// Least squares over the first `free` numbers from x on, by Gauss and Newton with steps that are halved until they
/// help.
Numbers converged(const RestModel& model, const FieldLaw& law, Numbers x, int free) {
  const double contact = lawOf(x, law).contact_ohm_mm2;
  const auto moved = [&](Numbers to) {
    if (free < kNumbers) to(2) = contact * std::exp(-to(0) - to(1));
    return to;
  };
  Eigen::MatrixXd slopes;
  Eigen::VectorXd left = model.left(law, x, &slopes);
  for (int i = 0; i < kMostSteps; ++i) {
    Numbers step = Numbers::Zero();
    step.head(free) = freeSlopes(slopes, x, free).colPivHouseholderQr().solve(left);
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > kLongestStep) step *= kLongestStep / longest;
    bool better = false;
    for (int halves = 0; halves < 6 && !better; ++halves, step /= 2) {
      if (x(2) + step(2) <= -1) continue; // a sphere that conducts better than without any contact at all
      const Numbers next = moved(x + step);
      const Eigen::VectorXd trial = model.left(law, next);
      better = trial.allFinite() && trial.squaredNorm() <= left.squaredNorm();
      if (better) {
        x = next;
        break;
      }
    }
    if (!better) break;
    left = model.left(law, x, &slopes);
    if (step.cwiseAbs().maxCoeff() < kSettled) break;
  }
  return x;
}

/// From the given law on, with the resistivity that has the right mean first: R is proportional to it but for wires.
Numbers start(const RestModel& model, const FieldLaw& law) {
  Numbers x = numbersOf(law);
  const Eigen::VectorXd left = model.left(law, x);
  if (left.allFinite()) x(1) += left.mean();
  return x;
}

RestFit fitted(const RestModel& model, const FieldLaw& law, double noise) {
  const Numbers first = start(model, law);
  int free = kNumbers;
  Numbers x = converged(model, law, first, free);
  RestFit fit;
  Eigen::MatrixXd slopes;
  Eigen::VectorXd left;
  Eigen::MatrixXd covariance;
  const auto judge = [&] {
    left = model.left(law, x, &slopes);
    fit.misfit = std::sqrt(left.squaredNorm() / static_cast<double>(model.readings()));
    const double scatter = std::sqrt(left.squaredNorm() / static_cast<double>(model.readings() - free));
    const Eigen::MatrixXd used = freeSlopes(slopes, x, free);
    covariance = std::pow(std::max(noise, scatter), 2) * (used.transpose() * used).inverse();
  };
  judge();
  bool none = false;
  if (!(covariance(0, 0) >= 0 && std::sqrt(covariance(0, 0)) <= kUndetermined)) { // also where it is NaN
    fit.keptContact = "these readings do not distinguish it from the radius";
  } else if (x(2) < 0) {
    none = true;
    fit.keptContact = "the readings fit best without it";
  }
  if (!fit.keptContact.empty()) {
    free = 2;
    Numbers kept = first;
    kept(2) = none ? 0 : law.contact_ohm_mm2 * std::exp(-first(0) - first(1));
    x = converged(model, law, kept, free);
    judge();
  } else {
    fit.correlation = covariance(0, 2) / std::sqrt(covariance(0, 0) * covariance(2, 2));
  }
  fit.law = lawOf(x, law);
  fit.radiusDeviation_mm = fit.law.electrodeRadius_mm * std::sqrt(covariance(0, 0));
  fit.resistivityDeviation_ohm_mm = fit.law.resistivity_ohm_mm * std::sqrt(covariance(1, 1));
  if (free == kNumbers) { // contact = k rho a
    const double scale = fit.law.resistivity_ohm_mm * fit.law.electrodeRadius_mm;
    const Eigen::Vector3d slope = scale * Eigen::Vector3d(x(2), x(2), 1);
    fit.contactDeviation_ohm_mm2 = std::sqrt(slope.dot(covariance * slope));
  }
  fit.left = model.placed(left);
  fit.readings = static_cast<int>(model.readings());
  return fit;
}

const FieldLaw& requireReadings(const SensorDesign& design, const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm) {
  const FieldLaw* law = design.field();
  if (!law)
    throw Error("resistance.law: " +
                gotExpected("pairs, which has no electrode radius, resistivity or contact to fit", "field"));
  if (resistances_ohm.rows() != design.rowWires() || resistances_ohm.cols() != design.columnWires())
    throw Error("readings of " + std::to_string(resistances_ohm.rows()) + " x " +
                std::to_string(resistances_ohm.cols()) + " wires; the design has " + std::to_string(design.rowWires()) +
                " x " + std::to_string(design.columnWires()));
  const auto known = (!resistances_ohm.array().isNaN()).count();
  if (known < kFewestReadings)
    throw Error("readings at rest: " +
                gotExpected(std::to_string(known), std::to_string(kFewestReadings) + " or more"));
  for (const double r_ohm : resistances_ohm.reshaped())
    if (!std::isnan(r_ohm) && !(r_ohm > 0 && std::isfinite(r_ohm)))
      throw Error("readings at rest: " + gotExpected(r_ohm, " ohm", "resistances above 0"));
  return *law;
}

/// Name of the wire whose readings are furthest from the fit on average.
std::string worstWire(const Eigen::MatrixXd& left) {
  std::string worst;
  double furthest = 0;
  const auto look = [&](const char* kind, Eigen::Index wire, const Eigen::ArrayXd& values) {
    const auto known = (!values.isNaN()).count();
    if (known == 0) return;
    const double mean = values.isNaN().select(0, values).sum() / static_cast<double>(known);
    if (std::abs(mean) <= std::abs(furthest)) return;
    furthest = mean;
    worst = std::string(kind) + std::to_string(wire);
  };
  for (Eigen::Index r = 0; r < left.rows(); ++r) look("row-wire ", r, left.row(r).transpose().array());
  for (Eigen::Index c = 0; c < left.cols(); ++c) look("column-wire ", c, left.col(c).array());
  return worst + " (" + withSign(withDecimals(100 * std::expm1(furthest), 1)) + " % on the mean)";
}

} // namespace

RestFit fitAtRest(const SensorDesign& design, const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm, double noise,
                  const std::stop_token& stop) {
  const FieldLaw& law = requireReadings(design, resistances_ohm);
  return fitted(RestModel(design, resistances_ohm, stop), law, noise);
}

std::string whyNoFit(const RestFit& fit, const SensorDesign& design,
                     const Eigen::Ref<const Eigen::MatrixXd>& resistances_ohm, double noise,
                     const std::stop_token& stop) {
  if (fit.misfit <= kRestFits) return {};
  const RestModel model(design, resistances_ohm, stop);
  const Readout given = requireReadings(design, resistances_ohm).readout;
  std::optional<Readout> best;
  double least = fit.misfit / 2; // else nothing is gained
  for (const auto& [readout, name] : kReadouts.all()) {
    if (readout == given) continue;
    FieldLaw law = *design.field();
    law.readout = readout;
    const double misfit = fitted(model, law, noise).misfit;
    if (!(misfit < least)) continue;
    least = misfit;
    best = readout;
  }
  const std::string start =
      "R at rest does not fit the design: " + withDigits(100 * fit.misfit, 2) + " % of R is left (rms), ";
  if (!best || least > kRestFits)
    return start + "most at " + worstWire(fit.left) + ": a wire or its contact is broken, or the design is another";
  return start + "read-out " + kReadouts.name(*best) + " leaves " + withDigits(100 * least, 2) +
         " %: the board reads otherwise than the design's " + kReadouts.name(given);
}

} // namespace palp
