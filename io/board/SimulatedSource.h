#pragma once

#include "io/board/ReportSource.h"
#include "io/board/VirtualBoard.h"

#include <atomic>
#include <memory>
#include <mutex>

namespace palp {

/// What is done to the virtual board while it runs; from any thread.
class SimulationControl {
public:
  std::atomic<bool> pluggedIn{true};

  void set(const BoardFaults& faults, const BoardDisturbance& disturbance);
  /// Gives a board what was set, where that is another state than the one it has; 0: it has none yet, as one that has
  /// just been opened. Returns the state that it has now. In the source's thread.
  std::uint64_t applyTo(VirtualBoard& board, std::uint64_t applied);
  /// A released board keeps its temperature, which continues as it would have while it is away.
  void keepWarmth(const VirtualBoard& board);
  void giveWarmth(VirtualBoard& board);

private:
  std::mutex mutex_;
  std::atomic<std::uint64_t> state_{0}; ///< how often something was set
  BoardFaults faults_;
  BoardDisturbance disturbance_;
  double warmth_degC_ = 0, warmthAt_s_ = 0; ///< host clock
};

/// The virtual board on the host's clock.
class SimulatedSource : public ReportSource {
public:
  explicit SimulatedSource(VirtualBoard board, std::shared_ptr<SimulationControl> control = {});
  ~SimulatedSource() override;

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] const BoardInfo& info() const override { return board_.info(); }
  [[nodiscard]] const BoardConfiguration& configuration() const override { return board_.configuration(); }
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override;
  bool configure(const BoardConfiguration& configuration) override;
  bool send(const BoardCommand& command) override;
  [[nodiscard]] std::string reason() const override { return "the simulated board was pulled out"; }

  VirtualBoard& board() { return board_; }

private:
  VirtualBoard board_;
  std::shared_ptr<SimulationControl> control_; ///< null: nobody interferes
  std::uint64_t applied_ = 0;                  ///< state of the control that this board has
  std::deque<RawReport> queue_;
};

} // namespace palp
