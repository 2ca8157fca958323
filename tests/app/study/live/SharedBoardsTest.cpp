#include "app/study/live/SharedBoards.h"

#include "tests/app/study/live/LiveFixture.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace palp {
namespace {

/// Two boards with one serial, as cheap ones have; what is opened is said by its path.
class SharedBoardsTest : public testing::Test {
protected:
  SharedBoardsTest() {
    BoardAccess access;
    access.list = [this] { return boards_; };
    access.open = [this](const std::string& device) -> std::unique_ptr<ReportSource> {
      opened_.push_back(device);
      if (refuses_) throw BoardError("no answer");
      return std::make_unique<SimulatedSource>(simulatedBoard(shippedSamples(), {}, 1000, 1));
    };
    shared_ = std::make_shared<SharedBoards>(access);
  }
  std::vector<HidBoard> boards_{{"/dev/hidraw0", "PALP", "", true}, {"/dev/hidraw1", "PALP", "", true}};
  std::vector<std::string> opened_;
  bool refuses_ = false;
  std::shared_ptr<SharedBoards> shared_;
};

TEST_F(SharedBoardsTest, TheFirstBoardIsTheFirstThatNobodyElseReads) {
  const BoardAccess one = shared_->accessOf(0), two = shared_->accessOf(1), three = shared_->accessOf(2);
  const auto first = one.open("");
  auto second = two.open("");
  EXPECT_EQ(opened_, (std::vector<std::string>{"/dev/hidraw0", "/dev/hidraw1"}));
  EXPECT_EQ(three.open(""), nullptr) << "as if there were none";
  EXPECT_FALSE(three.free(boards_[1]));
  second.reset();
  EXPECT_TRUE(three.free(boards_[1]));
  EXPECT_NE(three.open("PALP"), nullptr) << "the serial's second board";
}

TEST_F(SharedBoardsTest, ABoardThatAnotherOneReadsIsRefusedByName) {
  const auto first = shared_->accessOf(0).open("/dev/hidraw0");
  try {
    static_cast<void>(shared_->accessOf(1).open("/dev/hidraw0"));
    FAIL() << "it was opened twice";
  } catch (const BoardError& refusal) {
    EXPECT_EQ(std::string(refusal.what()),
              "PALP at /dev/hidraw0: is already open in another view; choose another board");
  }
  EXPECT_EQ(shared_->accessOf(1).open("/dev/hidraw7"), nullptr);
}

TEST_F(SharedBoardsTest, AReaderOpensItsOwnBoardAgainBeforeTheOldOneHasEnded) {
  const BoardAccess access = shared_->accessOf(0);
  auto old = access.open("/dev/hidraw0");
  const auto now = access.open("/dev/hidraw0");
  EXPECT_NE(now, nullptr);
  old.reset();
  EXPECT_FALSE(shared_->accessOf(1).free(boards_[0])) << "the new one still reads it";
}

TEST_F(SharedBoardsTest, ABoardThatCannotBeOpenedIsNobodys) {
  refuses_ = true;
  EXPECT_THROW(static_cast<void>(shared_->accessOf(0).open("")), BoardError);
  EXPECT_TRUE(shared_->accessOf(1).free(boards_[0]));
}

} // namespace
} // namespace palp
