#include "app/study/live/BoardCheck.h"

#include "tests/app/study/live/PluggedBoard.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

TEST(BoardCheck, PassesAGoodBoardAndFindsABadOne) {
  for (const int corruptEvery : {0, 50}) {
    LiveOptions options;
    options.reconnect = false;
    options.open = [corruptEvery] {
      VirtualBoard board = paperBoard();
      board.faults().corruptEvery = corruptEvery;
      return std::make_unique<SimulatedSource>(std::move(board));
    };
    LiveSession live(std::move(options));
    ASSERT_TRUE(waitFor(live, [](const LiveStatus& status) { return status.counts.reports >= 500; }));
    live.stop();
    const LiveStatus status = live.status();
    const std::vector<std::uint8_t> descriptor(reportDescriptor().begin(), reportDescriptor().end());
    const auto results = checkBoard(status, static_cast<double>(status.counts.reports) / 1000, descriptor);
    EXPECT_EQ(std::all_of(results.begin(), results.end(), [](const auto& result) { return result.passed; }),
              corruptEvery == 0);
  }
}

} // namespace
} // namespace palp
