#include "app/gui/reports/ReportPlan.h"

#include <QSettings>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kTrust = 0.05; ///< share of the plan that counts as run as planned, before anything is known
constexpr double kShortest_s = 0.01;

QString key(const QString& kind) {
  return "reportTimes/" + kind;
}

} // namespace

ReportPlan::ReportPlan(const QString& kind, std::vector<RunPart> parts) : kind_(kind), parts_(std::move(parts)) {
  const QStringList kept = QSettings().value(key(kind_)).toStringList();
  here_ = !parts_.empty() && kept.size() == static_cast<qsizetype>(parts_.size());
  for (std::size_t k = 0; here_ && k < parts_.size(); ++k)
    parts_[k].seconds = std::max(kept[static_cast<qsizetype>(k)].toDouble(), kShortest_s);
}

double ReportPlan::seconds() const {
  return planned_s(1);
}

double ReportPlan::planned_s(double share) const {
  double planned = 0, from = 0;
  for (const RunPart& part : parts_) {
    if (share >= part.until)
      planned += part.seconds;
    else if (share > from)
      planned += part.seconds * (share - from) / (part.until - from);
    from = part.until;
  }
  return planned;
}

double ReportPlan::left_s(double share, double elapsed_s) const {
  const double all = seconds(), done = planned_s(share);
  return (all - done) * (elapsed_s + kTrust * all) / (done + kTrust * all);
}

std::size_t ReportPlan::partAt(double share) const {
  const auto part =
      std::find_if(parts_.begin(), parts_.end(), [share](const RunPart& one) { return share < one.until; });
  return std::min(static_cast<std::size_t>(part - parts_.begin()), parts_.empty() ? 0 : parts_.size() - 1);
}

void ReportPlan::remember(const std::vector<double>& seconds) const {
  if (seconds.size() != parts_.size()) return;
  QStringList texts;
  for (const double value : seconds) texts << QString::number(value, 'g', 4);
  QSettings().setValue(key(kind_), texts);
}

} // namespace palp
