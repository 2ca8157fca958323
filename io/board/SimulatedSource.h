#pragma once

#include "io/board/Board.h"
#include "io/board/ReportSource.h"

namespace palp {

/// The virtual board on the host's clock.
class SimulatedSource : public ReportSource {
public:
  explicit SimulatedSource(Board board);

  [[nodiscard]] std::string name() const override;
  [[nodiscard]] const BoardInfo& info() const override { return board_.info(); }
  [[nodiscard]] const BoardConfiguration& configuration() const override { return board_.configuration(); }
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override;
  bool configure(const BoardConfiguration& configuration) override;
  bool send(const BoardCommand& command) override;

  Board& board() { return board_; }

private:
  Board board_;
  std::deque<RawReport> queue_;
};

} // namespace palp
