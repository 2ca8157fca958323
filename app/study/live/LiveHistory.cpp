#include "app/study/live/LiveHistory.h"

#include "io/AtomicFile.h"
#include "io/CsvText.h"
#include "model/base/Text.h"

#include <cmath>
#include <sstream>

namespace palp {

namespace {

constexpr double kGap_s = 0.25;   // as long as a board may be silent before it counts as stalled
constexpr double kGapPeriods = 3; // and of the time between the two frames before, where a board is slow
constexpr double kMostJump_s = 2; // device and host farther apart than this: another clock

void writeNumbers(std::ostream& out, const Eigen::MatrixXd& values, Eigen::Index count) {
  const auto all = values.reshaped();
  for (Eigen::Index k = 0; k < count; ++k) {
    out << ',';
    if (k < all.size() && std::isfinite(all(k))) out << text(all(k));
  }
}

} // namespace

void LiveHistory::add(std::shared_ptr<const LiveFrame> frame) {
  const bool jumped = !entries_.empty() && frame->jumps != entries_.back().frame->jumps;
  if (jumped) clear();
  // Where a recording continues at another place, the mark there began before it.
  std::string markBefore = entries_.empty() ? std::string() : entries_.back().frame->mark;
  if (jumped && !frame->markFollowsJump) markBefore = frame->mark;
  const bool newMark = !frame->mark.empty() && frame->mark != markBefore;
  const double host_s = frame->frame.hostTime_s;
  const double device_s = frame->frame.time_s;
  const bool otherClock = entries_.empty() || frame->frame.restarted ||
                          std::abs(device_s + offset_s_ - host_s) > kMostJump_s ||
                          device_s + offset_s_ < entries_.back().t_s;
  if (otherClock) {
    offset_s_ = host_s - device_s;
    if (!entries_.empty()) offset_s_ = std::max(offset_s_, entries_.back().t_s - device_s);
  }
  if (frame->forces.valid) lastValid_ = frame;
  const double t_s = device_s + offset_s_;
  bool gap = false;
  if (!entries_.empty()) {
    const Entry& last = entries_.back();
    const double step_s = t_s - last.t_s;
    gap = frame->frame.restarted || frame->connection != last.frame->connection ||
          (period_s_ > 0 && step_s > kGap_s && step_s > kGapPeriods * period_s_);
    period_s_ = step_s;
  }
  entries_.push_back({t_s, std::move(frame), gap, newMark});
  while (entries_.size() > kMostFrames || entries_.back().t_s - entries_.front().t_s > kLongest_s) entries_.pop_front();
}

void LiveHistory::clear() {
  entries_.clear();
  lastValid_.reset();
  period_s_ = 0;
}

void writeLiveCsv(const std::filesystem::path& path, const LiveHistory& history, const std::string& head) {
  Eigen::Index forces = 0, readings = 0;
  int rows = 0;
  for (const LiveHistory::Entry& entry : history.entries()) {
    forces = std::max(forces, entry.frame->forces.forces_N.size());
    readings = std::max(readings, entry.frame->change.size());
    rows = std::max(rows, static_cast<int>(entry.frame->change.rows()));
  }
  std::ostringstream out;
  out << head << "t_s,board_s,frame,complete,valid,area,latency_ms,lost_reports,temperature_degC,misfit,mark";
  for (Eigen::Index k = 0; k < forces; ++k)
    out << ",a" << k / 3 << "_f"
        << "xyz"[k % 3] << "_N";
  for (Eigen::Index k = 0; k < forces; ++k)
    out << ",a" << k / 3 << "_sd"
        << "xyz"[k % 3] << "_N";
  for (Eigen::Index k = 0; k < readings; ++k) out << ",dR_r" << k % rows << "_c" << k / rows << "_relative";
  out << ",reason\n";
  std::string mark;
  for (const LiveHistory::Entry& entry : history.entries()) {
    const LiveFrame& live = *entry.frame;
    out << text(entry.t_s) << ',' << text(live.frame.time_s) << ',';
    out << live.frame.number << ',' << live.frame.complete << ',' << live.forces.valid << ',';
    if (live.forces.area) out << *live.forces.area;
    out << ',' << text(1e3 * live.latency_s) << ',' << live.lostReports << ',';
    if (live.frame.temperature_degC) out << text(*live.frame.temperature_degC);
    out << ',';
    if (live.forces.misfit) out << text(*live.forces.misfit);
    out << ',' << quotedCsvField(live.mark == mark ? std::string() : live.mark);
    mark = live.mark;
    writeNumbers(out, live.forces.measuredAlone(live.forces.forces_N), forces);
    writeNumbers(out, live.forces.measuredAlone(live.forces.standardDeviation_N), forces);
    writeNumbers(out, live.change, readings);
    out << ',' << quotedCsvField(live.forces.valid ? live.forces.doubt : live.forces.reason) << '\n';
  }
  writeFile(path, out.str(), true);
}

} // namespace palp
