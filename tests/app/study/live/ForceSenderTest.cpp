#include "app/study/live/send/ForceSender.h"

#include <gtest/gtest.h>

#include <future>

namespace palp {
namespace {

constexpr std::chrono::seconds kSurely{60};

/// Lets the first frame go only when it is told to.
class StuckOutlet : public ForceOutlet {
public:
  explicit StuckOutlet(std::shared_future<void> released) : released_(std::move(released)) {}
  bool send(const OutgoingFrame& frame, std::chrono::milliseconds /*patience*/) override {
    released_.wait();
    return frame.valid;
  }

private:
  std::shared_future<void> released_;
};

/// Never waits, and tells in which thread it was called.
class PromptOutlet : public ForceOutlet {
public:
  explicit PromptOutlet(std::thread::id& caller) : caller_(caller) {}
  bool send(const OutgoingFrame& frame, std::chrono::milliseconds /*patience*/) override {
    caller_ = std::this_thread::get_id();
    if (frame.frame == 7) throw std::runtime_error("not this one");
    return frame.valid;
  }
  [[nodiscard]] bool mayWait() const override { return false; }

private:
  std::thread::id& caller_;
};

std::shared_ptr<const LiveFrame> liveFrame(bool valid) {
  auto frame = std::make_shared<LiveFrame>();
  frame->forces.valid = valid;
  frame->forces.forces_N = Eigen::Vector3d(1, -0.5, -6);
  return frame;
}

TEST(ForceSender, WhoGivesNeverWaitsAndWhatIsTooMuchIsDroppedAndCounted) {
  std::promise<void> release;
  ForceSender sender(std::make_unique<StuckOutlet>(release.get_future().share()));
  for (int i = 0; i < 3000; ++i) sender.give(liveFrame(true), 0); // returns, though nothing goes
  EXPECT_EQ(sender.counts().sent, 0U);
  EXPECT_GE(sender.counts().dropped, 1975U); // 1024 wait, one is on its way
  release.set_value();
  sender.finish(kSurely);
  EXPECT_GE(sender.counts().sent, 1024U);
  EXPECT_EQ(sender.counts().sent + sender.counts().dropped, 3000U);
}

TEST(ForceSender, CountsWhatTheReceiverDidNotTake) {
  std::promise<void> release;
  release.set_value();
  ForceSender sender(std::make_unique<StuckOutlet>(release.get_future().share()));
  sender.give(liveFrame(true), 0);
  sender.give(liveFrame(false), 0);
  sender.finish(kSurely);
  EXPECT_EQ(sender.counts().sent, 1U);
  EXPECT_EQ(sender.counts().dropped, 1U);
}

TEST(ForceSender, SendsAtOnceInTheThreadThatGivesWhereNothingWaits) {
  std::thread::id caller;
  ForceSender sender(std::make_unique<PromptOutlet>(caller));
  sender.give(liveFrame(true), 0);
  EXPECT_EQ(caller, std::this_thread::get_id());
  EXPECT_EQ(sender.counts().sent, 1U) << "when give() returns";
  sender.give(liveFrame(false), 0);
  auto refused = std::make_shared<LiveFrame>(*liveFrame(true));
  refused->frame.number = 7;
  sender.give(refused, 0);
  EXPECT_EQ(sender.counts().dropped, 2U);
  EXPECT_NE(sender.counts().failure.find("not this one"), std::string::npos) << sender.counts().failure;
  std::vector<std::jthread> several; // boards that share a receiver
  for (int t = 0; t < 4; ++t)
    several.emplace_back([&] {
      for (int i = 0; i < 100; ++i) sender.give(liveFrame(true), 0);
    });
  several.clear();
  sender.finish(kSurely);
  EXPECT_EQ(sender.counts().sent, 401U);
  EXPECT_GT(sender.counts().latency.longest_s, 0);
}

TEST(OutgoingFrame, HasItsUnitsInItsNamesAndNoForcesWhereThereAreNone) {
  OutgoingFrame frame;
  frame.device_s = 0.25;
  frame.host_unix_s = 1.5;
  frame.frame = 7;
  EXPECT_EQ(frameAsJson(frame), R"({"device_s":0.25,"host_unix_s":1.5,"frame":7,"valid":0})");
  EXPECT_EQ(frameAsCsv(frame, 1), "0.25,1.5,7,0,,,,,,,\n");
  frame.valid = true;
  frame.area = 4;
  frame.forces_N = Eigen::Vector3d(1, -0.5, -6);
  EXPECT_EQ(frameAsJson(frame), R"({"device_s":0.25,"host_unix_s":1.5,"frame":7,"valid":1,"fx_N":1,"fy_N":-0.5,)"
                                R"("fz_N":-6,"area":4})");
  EXPECT_EQ(frameCsvHead(1), "device_s,host_unix_s,frame,valid,area,fx_N,fy_N,fz_N,sd_fx_N,sd_fy_N,sd_fz_N\n");
  EXPECT_EQ(frameAsCsv(frame, 1), "0.25,1.5,7,1,4,1,-0.5,-6,,,\n");
  frame.doubted = true;
  EXPECT_NE(frameAsJson(frame).find(R"("area":4,"doubted":1})"), std::string::npos) << frameAsJson(frame);
  frame.forces_N = Eigen::Matrix3Xd::Ones(3, 2); // one for each area
  EXPECT_NE(frameAsJson(frame).find(R"("a1_fz_N":1)"), std::string::npos);
}

} // namespace
} // namespace palp
