#include "solver/statics/StepOutcome.h"

#include "model/base/Text.h"

namespace palp {

std::string stopReason(StepOutcome outcome, int iterationsAStep, double reached, double tried) {
  const std::string where = " between load fractions " + text(reached) + " and " + text(tried);
  switch (outcome) {
  case StepOutcome::Converged:
    return {};
  case StepOutcome::Cancelled:
    return "cancelled at load fraction " + text(reached);
  case StepOutcome::Inverted:
    return "elements turn inside out" + where;
  case StepOutcome::Indefinite:
    return "the tangent is no longer positive definite (the block loses stability)" + where;
  case StepOutcome::NoContact:
    return "no contact in equilibrium is found" + where;
  case StepOutcome::TooManyIterations:
    return "no convergence in " + std::to_string(iterationsAStep) + " iterations" + where;
  case StepOutcome::Diverged:
    return "Newton's iteration diverges" + where;
  }
  return {};
}

} // namespace palp
