#pragma once

#include "io/board/Protocol.h"
#include "io/board/Tare.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace palp {

/// The tares of the boards that were read, for when one is read again: after a recording was played in between.
class KeptTares {
public:
  /// The board's tare as it is now; null: it has none any more.
  void keep(const BoardInfo& board, const std::shared_ptr<const Tare>& tare) {
    const auto known =
        std::find_if(tares_.begin(), tares_.end(), [&](const Kept& kept) { return kept.board == board; });
    if (known != tares_.end())
      known->tare = tare;
    else if (tare)
      tares_.push_back({board, tare});
  }
  [[nodiscard]] std::shared_ptr<const Tare> of(const BoardInfo& board) const {
    const auto known =
        std::find_if(tares_.begin(), tares_.end(), [&](const Kept& kept) { return kept.board == board; });
    return known == tares_.end() ? nullptr : known->tare;
  }
  void clear() { tares_.clear(); }

private:
  struct Kept {
    BoardInfo board;
    std::shared_ptr<const Tare> tare;
  };
  std::vector<Kept> tares_;
};

} // namespace palp
