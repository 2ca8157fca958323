#include "tests/app/study/live/PluggedBoard.h"

#include <gtest/gtest.h>

#include <array>
#include <ostream>
#include <stdexcept>
#include <tuple>

namespace palp {
namespace {

/// Where a source fails, and with what.
enum class FailingCall { Open, Name, Info, Configuration, Read, Configure, ReadConfiguration };
enum class Thrown { BoardGone, Refusal, Standard, Foreign };
/// In the names of the tests.
void PrintTo(FailingCall call, std::ostream* out) {
  constexpr std::array words{"open", "name", "info", "configuration", "read", "configure", "readConfiguration"};
  *out << words.at(static_cast<std::size_t>(call));
}
void PrintTo(Thrown thrown, std::ostream* out) {
  constexpr std::array words{"board gone", "refusal", "a standard exception", "a foreign exception"};
  *out << words.at(static_cast<std::size_t>(thrown));
}

/// Throws at one of its calls while it is armed.
struct Trap {
  FailingCall call;
  Thrown thrown;
  std::atomic<bool> armed{false};
  std::atomic<int> sprung{0};

  void at(FailingCall now) {
    if (!armed || now != call) return;
    ++sprung;
    switch (thrown) {
    case Thrown::BoardGone:
      throw BoardError("trapped");
    case Thrown::Refusal:
      throw Error("trapped");
    case Thrown::Standard:
      throw std::out_of_range("trapped");
    case Thrown::Foreign:
      throw 7; // NOLINT(hicpp-exception-baseclass): what no handler of a kind catches
    }
  }
};

class TrappedSource : public SimulatedSource {
public:
  explicit TrappedSource(std::shared_ptr<Trap> trap) : SimulatedSource(paperBoard()), trap_(std::move(trap)) {}
  [[nodiscard]] std::string name() const override {
    trap_->at(FailingCall::Name);
    return SimulatedSource::name();
  }
  [[nodiscard]] const BoardInfo& info() const override {
    trap_->at(FailingCall::Info);
    return SimulatedSource::info();
  }
  [[nodiscard]] const BoardConfiguration& configuration() const override {
    trap_->at(FailingCall::Configuration);
    return SimulatedSource::configuration();
  }
  void readConfiguration() override { trap_->at(FailingCall::ReadConfiguration); }
  Outcome read(RawReport& report, std::chrono::milliseconds timeout) override {
    trap_->at(FailingCall::Read);
    if (trap_->armed && trap_->call == FailingCall::ReadConfiguration) { // makes the session read it again
      BoardEvent changed;
      changed.code = EventCode::ConfigurationChanged;
      const Report bytes = encode(changed);
      report = {hostClock_s(), {bytes.begin(), bytes.end()}};
      return Outcome::Read;
    }
    return SimulatedSource::read(report, timeout);
  }
  bool configure(const BoardConfiguration& configuration) override {
    trap_->at(FailingCall::Configure);
    return SimulatedSource::configure(configuration);
  }

private:
  std::shared_ptr<Trap> trap_;
};

class LiveSessionFailure : public testing::TestWithParam<std::tuple<FailingCall, Thrown>> {};

TEST_P(LiveSessionFailure, EndsTheConnectionAndSaysWhyNeverTheProgram) {
  auto trap = std::make_shared<Trap>();
  std::tie(trap->call, trap->thrown) = GetParam();
  const bool opening = trap->call == FailingCall::Open;
  const bool whileConnecting = trap->call <= FailingCall::Configuration;
  trap->armed = whileConnecting;
  LiveOptions options;
  options.open = [trap] {
    trap->at(FailingCall::Open);
    return std::make_unique<TrappedSource>(trap);
  };
  LiveSession live(std::move(options));
  if (!whileConnecting) {
    ASSERT_TRUE(waitForFrames(live, 2));
    trap->armed = true;
    BoardConfiguration wanted = *live.status().configuration;
    wanted.rate_Hz = 500;
    live.configure(wanted);
  }
  const auto words = [&](const LiveStatus& now) { return opening ? now.reason : now.lastEvent; };
  ASSERT_TRUE(waitFor(live, [&](const LiveStatus& now) { return trap->sprung > 0 && !words(now).empty(); }));
  const std::string why = words(live.status());
  EXPECT_NE(why.find(trap->thrown == Thrown::Foreign ? "internal error" : "trapped"), std::string::npos) << why;
  trap->armed = false;
  EXPECT_TRUE(waitForState(live, LiveState::Streaming)); // and goes on when all is well again
}

INSTANTIATE_TEST_SUITE_P(AtEachCall, LiveSessionFailure,
                         testing::Combine(testing::Values(FailingCall::Open, FailingCall::Name, FailingCall::Info,
                                                          FailingCall::Configuration, FailingCall::Read,
                                                          FailingCall::Configure, FailingCall::ReadConfiguration),
                                          testing::Values(Thrown::BoardGone, Thrown::Refusal, Thrown::Standard,
                                                          Thrown::Foreign)));

} // namespace
} // namespace palp
