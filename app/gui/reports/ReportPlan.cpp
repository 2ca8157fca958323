#include "app/gui/reports/ReportPlan.h"

#include <QSettings>
#include <QStringList>

#include <algorithm>
#include <numeric>

namespace palp {

namespace {

constexpr double kTrust = 0.05; ///< share of the plan that counts as run as planned, before anything is known
constexpr double kShortest_s = 0.01;

constexpr double kStep = 0.005;               ///< share of the run's time that a step takes at least, to be kept as one
constexpr const char* kSpeed = "reportSpeed"; ///< time of the last report here over its estimate

QString key(const QString& kind) {
  return "reportTimes/" + kind;
}

QString momentsKey(const QString& kind) {
  return "reportMoments/" + kind;
}

double sum_s(const std::vector<RunPart>& parts) {
  return std::accumulate(parts.begin(), parts.end(), 0.0,
                         [](double before, const RunPart& part) { return before + part.seconds; });
}

/// "share seconds", ascending in both; nothing where that is not what the settings hold.
std::vector<RunMoment> momentsOf(const QStringList& texts) {
  std::vector<RunMoment> moments{{0, 0}};
  for (const QString& text : texts) {
    const QStringList pair = text.split(' ');
    const RunMoment next{pair.value(0).toDouble(), pair.value(1).toDouble()};
    if (!(next.share > moments.back().share && next.share <= 1 && next.seconds >= moments.back().seconds)) return {};
    moments.push_back(next);
  }
  return moments.back().share == 1 ? moments : std::vector<RunMoment>{};
}

/// The same of a run of `all` seconds, without the moments between which hardly any time passed: both ends of each
/// step stay, because the progress stops at the first of them.
QStringList textsOf(const std::vector<RunMoment>& moments, double all) {
  QStringList texts;
  RunMoment kept;
  for (std::size_t k = 0; k < moments.size(); ++k) {
    const RunMoment& moment = moments[k];
    const double next_s = k + 1 < moments.size() ? moments[k + 1].seconds : all;
    const bool ends = moment.seconds - kept.seconds >= kStep * all, begins = next_s - moment.seconds >= kStep * all;
    if (!(moment.share > kept.share && moment.share < 1 && (ends || begins))) continue;
    kept = moment;
    texts << QString("%1 %2").arg(moment.share, 0, 'g', 10).arg(moment.seconds, 0, 'f', 3);
  }
  return texts << QString("1 %1").arg(all, 0, 'f', 3);
}

} // namespace

ReportPlan::ReportPlan(const QString& kind, std::vector<RunPart> parts)
    : kind_(kind), parts_(std::move(parts)), shipped_s_(sum_s(parts_)) {
  const QSettings settings;
  const QStringList kept = settings.value(key(kind_)).toStringList();
  here_ = !parts_.empty() && kept.size() == static_cast<qsizetype>(parts_.size());
  for (std::size_t k = 0; here_ && k < parts_.size(); ++k)
    parts_[k].seconds = std::max(kept[static_cast<qsizetype>(k)].toDouble(), kShortest_s);
  if (here_) moments_ = momentsOf(settings.value(momentsKey(kind_)).toStringList());
  const double speed = settings.value(kSpeed, 1).toDouble();
  for (RunPart& part : parts_)
    if (!here_ && speed > 0) part.seconds *= speed;
}

double ReportPlan::seconds() const {
  return moments_.empty() ? sum_s(parts_) : moments_.back().seconds;
}

void ReportPlan::setSeconds(double seconds) {
  const double sum = sum_s(parts_);
  for (RunPart& part : parts_)
    if (sum > 0) part.seconds *= seconds / sum;
  moments_.clear();
  here_ = true;
}

double ReportPlan::planned_s(double share) const {
  if (!moments_.empty()) {
    const auto next = std::find_if(moments_.begin() + 1, moments_.end() - 1,
                                   [share](const RunMoment& moment) { return moment.share >= share; });
    const RunMoment &before = *(next - 1), &after = *next;
    const double way = std::clamp((share - before.share) / (after.share - before.share), 0.0, 1.0);
    return before.seconds + way * (after.seconds - before.seconds);
  }
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

double ReportPlan::stepDone_s(double share) const {
  if (moments_.empty()) return parts_.empty() ? 0 : planned_s(parts_[partAt(share)].until);
  const auto next =
      std::find_if(moments_.begin(), moments_.end(), [share](const RunMoment& moment) { return moment.share > share; });
  return next == moments_.end() ? seconds() : next->seconds;
}

double ReportPlan::left_s(const RunMoment& last, double elapsed_s) const {
  const double all = seconds(), done = planned_s(last.share);
  const double pace = (last.seconds + kTrust * all) / (done + kTrust * all);
  return std::max((all - done) * pace - (elapsed_s - last.seconds), (all - stepDone_s(last.share)) * pace);
}

std::size_t ReportPlan::partAt(double share) const {
  const auto part =
      std::find_if(parts_.begin(), parts_.end(), [share](const RunPart& one) { return share < one.until; });
  return std::min(static_cast<std::size_t>(part - parts_.begin()), parts_.empty() ? 0 : parts_.size() - 1);
}

void ReportPlan::remember(const std::vector<double>& seconds, const std::vector<RunMoment>& moments) const {
  if (seconds.size() != parts_.size()) return;
  QSettings settings;
  QStringList texts;
  for (const double value : seconds) texts << QString::number(value, 'g', 4);
  settings.setValue(key(kind_), texts);
  const double all = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  if (shipped_s_ > 0 && all > 0) settings.setValue(kSpeed, all / shipped_s_);
  settings.setValue(momentsKey(kind_), textsOf(moments, all));
}

} // namespace palp
