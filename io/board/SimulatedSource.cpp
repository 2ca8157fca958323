#include "io/board/SimulatedSource.h"

#include <algorithm>
#include <cmath>
#include <thread>

namespace palp {

namespace {

using Clock = std::chrono::steady_clock;

std::uint64_t microseconds(Clock::time_point time) {
  return static_cast<std::uint64_t>(
      std::chrono::duration_cast<std::chrono::microseconds>(time.time_since_epoch()).count());
}

} // namespace

void SimulationControl::set(const BoardFaults& faults, const BoardDisturbance& disturbance) {
  const std::lock_guard lock(mutex_);
  faults_ = faults;
  disturbance_ = disturbance;
  ++state_;
}

std::uint64_t SimulationControl::applyTo(VirtualBoard& board, std::uint64_t applied) {
  if (state_ == applied) return applied;
  const std::lock_guard lock(mutex_);
  board.faults() = faults_;
  board.disturbance() = disturbance_;
  return state_;
}

void SimulationControl::keepWarmth(const VirtualBoard& board) {
  const std::lock_guard lock(mutex_);
  warmth_degC_ = board.warmth_degC();
  warmthAt_s_ = hostClock_s();
}

void SimulationControl::giveWarmth(VirtualBoard& board) {
  const std::lock_guard lock(mutex_);
  const double away_s = hostClock_s() - warmthAt_s_, goal_degC = disturbance_.warming_degC;
  if (warmth_degC_ != 0)
    board.beginWarm(goal_degC + (warmth_degC_ - goal_degC) * std::exp(-away_s / disturbance_.warmingTime_s));
}

SimulatedSource::SimulatedSource(VirtualBoard board, std::shared_ptr<SimulationControl> control)
    : board_(std::move(board)), control_(std::move(control)) {
  if (control_) control_->giveWarmth(board_);
}

SimulatedSource::~SimulatedSource() {
  if (control_) control_->keepWarmth(board_);
}

std::string SimulatedSource::name() const {
  return "simulated board";
}

ReportSource::Outcome SimulatedSource::read(RawReport& report, std::chrono::milliseconds timeout) {
  const Clock::time_point end = Clock::now() + timeout;
  if (control_ && !control_->pluggedIn) return Outcome::Gone;
  if (control_) applied_ = control_->applyTo(board_, applied_);
  while (queue_.empty()) {
    const Clock::time_point now = Clock::now();
    board_.advance(microseconds(now), [&](std::span<const std::uint8_t> bytes) {
      queue_.push_back({hostClock_s(), {bytes.begin(), bytes.end()}});
    });
    if (!queue_.empty()) break;
    if (now >= end) return Outcome::Nothing;
    Clock::time_point wake = end;
    if (const auto due_us = board_.nextDue_us())
      wake = std::min(end, Clock::time_point(std::chrono::microseconds(*due_us)));
    std::this_thread::sleep_until(wake);
  }
  std::swap(report, queue_.front());
  queue_.pop_front();
  return Outcome::Read;
}

bool SimulatedSource::configure(const BoardConfiguration& configuration) {
  return board_.setFeature(encode(configuration));
}

bool SimulatedSource::send(const BoardCommand& command) {
  return board_.output(encode(command));
}

} // namespace palp
