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
  /// Takes what was set since the last call; in the source's thread.
  void applyTo(VirtualBoard& board);

private:
  std::mutex mutex_;
  std::atomic<bool> changed_{false};
  BoardFaults faults_;
  BoardDisturbance disturbance_;
};

/// The virtual board on the host's clock.
class SimulatedSource : public ReportSource {
public:
  explicit SimulatedSource(VirtualBoard board, std::shared_ptr<SimulationControl> control = {});

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
  std::deque<RawReport> queue_;
};

} // namespace palp
