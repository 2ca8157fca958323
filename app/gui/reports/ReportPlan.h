#pragma once

#include "app/study/reports/ReportComputations.h"

#include <QString>

#include <vector>

namespace palp {

/// A moment of a run: its reported progress.
struct RunMoment {
  double share = 0;   ///< 0..1
  double seconds = 0; ///< since its begin
};

/// How long a report takes, part by part, and its remaining time.
class ReportPlan {
public:
  ReportPlan() = default;
  /// The parts with the times that the kind's last run on this machine took, else those that come with Palp, as much
  /// longer or shorter as the last report took here.
  ReportPlan(const QString& kind, std::vector<RunPart> parts);

  [[nodiscard]] const std::vector<RunPart>& parts() const { return parts_; }
  /// The times are of a run on this machine.
  [[nodiscard]] bool measuredHere() const { return here_; }
  [[nodiscard]] double seconds() const;
  /// Of a run on this machine that took so long, part by part as it comes with Palp.
  void setSeconds(double seconds);
  /// Remaining time [s] after this many seconds, where `last` is the moment of the last reported progress: the
  /// plan's rest, as much slower or faster as the run was until then, less what passed since. At least what the plan
  /// asks for after the step that runs now, however long that step takes.
  [[nodiscard]] double left_s(const RunMoment& last, double elapsed_s) const;
  /// The part that a share lies in.
  [[nodiscard]] std::size_t partAt(double share) const;

  /// Keeps the times of a run that was done, one a part, and its moments for the next one.
  void remember(const std::vector<double>& seconds, const std::vector<RunMoment>& moments) const;

private:
  [[nodiscard]] double planned_s(double share) const;
  /// When the step that runs at this share is done: the next moment of the last run, else the end of the part.
  [[nodiscard]] double stepDone_s(double share) const;

  QString kind_;
  std::vector<RunPart> parts_;
  double shipped_s_ = 0;           ///< as Palp comes
  std::vector<RunMoment> moments_; ///< of the last run: within a part, too, one share takes longer than another
  bool here_ = false;
};

} // namespace palp
