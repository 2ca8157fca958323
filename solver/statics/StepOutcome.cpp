#include "solver/statics/StepOutcome.h"

#include "model/base/Text.h"
#include "solver/element/ElementKernels.h"

#include <cmath>

namespace palp {

namespace {

/// Steps are halved down to some thousandths: further digits of halves and sums of sixths are irrelevant.
std::string fractionInWords(double load) {
  return text(std::round(1e6 * load) / 1e6);
}

} // namespace

StepOutcome outcomeOfVolume(double smallestJ) {
  return smallestJ == lockedVolume ? StepOutcome::Locked : StepOutcome::Inverted;
}

std::string stopReason(StepOutcome outcome, int iterationsAStep, double reached, double tried) {
  const std::string where = " between load fractions " + fractionInWords(reached) + " and " + fractionInWords(tried);
  switch (outcome) {
  case StepOutcome::Converged:
    return {};
  case StepOutcome::Cancelled:
    return "cancelled at load fraction " + fractionInWords(reached);
  case StepOutcome::Inverted:
    return "elements turn inside out" + where;
  case StepOutcome::Locked:
    return "the rubber is stretched to the limit jm of Gent's law" + where;
  case StepOutcome::Indefinite:
    return "the tangent is no longer positive definite (the block loses stability)" + where;
  case StepOutcome::NoContact:
    return "the contact iteration did not converge" + where;
  case StepOutcome::TooManyIterations:
    return "no convergence in " + std::to_string(iterationsAStep) + " iterations" + where;
  case StepOutcome::Diverged:
    return "Newton's iteration diverges" + where;
  }
  return {};
}

} // namespace palp
