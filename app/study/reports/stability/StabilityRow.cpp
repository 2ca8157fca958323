#include "app/study/reports/stability/StabilityRow.h"

#include "model/base/Error.h"
#include "model/base/Text.h"
#include "solver/BatchSolver.h"

#include <chrono>

namespace palp {

std::string name(StabilityOutcome outcome) {
  switch (outcome) {
  case StabilityOutcome::Right:
    return "right";
  case StabilityOutcome::Stopped:
    return "stopped";
  case StabilityOutcome::Warned:
    return "warned";
  case StabilityOutcome::Refused:
    return "refused";
  case StabilityOutcome::Wrong:
    break;
  }
  return "wrong";
}

void judge(StabilityRow& row, double allowed) {
  if (row.error <= allowed) return;
  row.outcome = StabilityOutcome::Wrong;
  row.words = "error " + text(row.error) + " above the " + text(allowed) + " allowed here";
}

StabilityRow runCase(const std::string& group, const std::string& what,
                     const std::function<void(StabilityRow&)>& work) {
  StabilityRow row;
  row.group = group;
  row.what = what;
  const auto start = std::chrono::steady_clock::now();
  try {
    work(row);
  } catch (const ConvergenceError& stopped) {
    row.outcome = StabilityOutcome::Stopped;
    row.words = stopped.what();
  } catch (const Error& refused) {
    row.outcome = StabilityOutcome::Refused;
    row.words = refused.what();
  } catch (const std::exception& mistake) { // not hidden: the row turns red and has the message
    row.outcome = StabilityOutcome::Wrong;
    row.words = std::string("a mistake of the program: ") + mistake.what();
  }
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return row;
}

} // namespace palp
