#include "app/study/live/SharedBoards.h"

#include "model/base/Error.h"

namespace palp {

/// A board that nobody else may open until this has gone.
class HeldBoard final : public ReportSource {
public:
  HeldBoard(std::shared_ptr<SharedBoards> boards, std::string path)
      : boards_(std::move(boards)), path_(std::move(path)) {}
  ~HeldBoard() override {
    source_.reset(); // first: only then may another one open it
    boards_->release(path_);
  }
  HeldBoard(const HeldBoard&) = delete;
  HeldBoard& operator=(const HeldBoard&) = delete;

  void set(std::unique_ptr<ReportSource> source) { source_ = std::move(source); }
  [[nodiscard]] std::string name() const override { return source_->name(); }
  [[nodiscard]] const BoardInfo& info() const override { return source_->info(); }
  [[nodiscard]] const BoardConfiguration& configuration() const override { return source_->configuration(); }
  void readConfiguration() override { source_->readConfiguration(); }
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override { return source_->read(report, timeout); }
  bool configure(const BoardConfiguration& configuration) override { return source_->configure(configuration); }
  bool send(const BoardCommand& command) override { return source_->send(command); }
  [[nodiscard]] std::string reason() const override { return source_->reason(); }

private:
  std::shared_ptr<SharedBoards> boards_;
  std::string path_;
  std::unique_ptr<ReportSource> source_;
};

BoardAccess SharedBoards::accessOf(int reader) {
  BoardAccess access = access_;
  access.open = [boards = shared_from_this(), reader](const std::string& device) {
    return boards->open(device, reader);
  };
  access.free = [boards = shared_from_this(), reader](const HidBoard& board) {
    return boards->free(board.path, reader);
  };
  return access;
}

bool SharedBoards::free(const std::string& path, int reader) const {
  const std::lock_guard lock(mutex_);
  const auto holder = held_.find(path);
  return holder == held_.end() || holder->second.reader == reader;
}

bool SharedBoards::take(const std::string& path, int reader) {
  const std::lock_guard lock(mutex_);
  const auto [holder, fresh] = held_.try_emplace(path, Holder{reader, 0});
  if (holder->second.reader != reader) return false;
  ++holder->second.times;
  return true;
}

void SharedBoards::release(const std::string& path) {
  const std::lock_guard lock(mutex_);
  const auto holder = held_.find(path);
  if (--holder->second.times == 0) held_.erase(holder);
}

std::unique_ptr<ReportSource> SharedBoards::open(const std::string& device, int reader) {
  std::string taken;
  for (const HidBoard& board : access_.list()) {
    if (!device.empty() && board.serial != device && board.path != device) continue;
    if (!take(board.path, reader)) {
      taken = board.serial + " at " + board.path;
      continue;
    }
    auto held = std::make_unique<HeldBoard>(shared_from_this(), board.path); // released where it cannot be opened
    auto source = access_.open(board.path);
    if (!source) return nullptr;
    held->set(std::move(source));
    return held;
  }
  if (!device.empty() && !taken.empty())
    throw BoardError(taken + ": is already open in another view; choose another board");
  return nullptr;
}

} // namespace palp
