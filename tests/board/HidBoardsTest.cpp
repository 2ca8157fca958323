#include "io/board/HidBoards.h"

#include "io/board/FrameAssembler.h"
#include "io/board/Hotplug.h"
#include "tests/board/MockUsb.h"
#include "tests/io/Refusal.h"
#include "tests/io/board/SmallBoard.h"

#include <gtest/gtest.h>

#include <linux/capability.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace palp {
namespace {

constexpr auto kPatience = std::chrono::milliseconds(2000);

/// This thread without root's privilege to open every file; an ordinary user stays what he is.
class OrdinaryUser {
public:
  OrdinaryUser() {
    ::syscall(SYS_capget, &head_, before_);
    __user_cap_data_struct without[2] = {before_[0], before_[1]};
    without[0].effective &= ~(1U << CAP_DAC_OVERRIDE | 1U << CAP_DAC_READ_SEARCH);
    ::syscall(SYS_capset, &head_, without);
  }
  ~OrdinaryUser() { ::syscall(SYS_capset, &head_, before_); }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;

private:
  __user_cap_header_struct head_{_LINUX_CAPABILITY_VERSION_3, 0};
  __user_cap_data_struct before_[2] = {};
};

VirtualBoard namedBoard(const std::string& serial) {
  BoardSettings settings = smallBoard();
  settings.info.serial = serial;
  return boardWith(settings);
}

bool waitForChange(Hotplug& hotplug) {
  const double end_s = hostClock_s() + 2;
  while (hostClock_s() < end_s)
    if (hotplug.wait(std::chrono::milliseconds(50))) return true;
  return false;
}

TEST(HidBoards, FindsNoBoardWhereThereIsNone) {
  const MockUsb usb;
  EXPECT_TRUE(hidBoards().empty());
}

TEST(HidBoards, FindsTheBoardAndOpensIt) {
  MockUsb usb;
  const MockBoard mock(usb, namedBoard("PALP-1"), 1, 0);
  const std::vector<HidBoard> boards = hidBoards();
  ASSERT_EQ(boards.size(), 1U);
  EXPECT_EQ(boards[0].serial, "PALP-1");
  EXPECT_EQ(boards[0].path, "/dev/hidraw0");
  EXPECT_TRUE(boards[0].permission);
  EXPECT_TRUE(hidBoards({0x1209, 0x0002}).empty());
  const auto source = openHidBoard(boards[0]);
  EXPECT_EQ(source->info().rowWires, 3);
  EXPECT_EQ(source->info().serial, "PALP-1");
  EXPECT_EQ(source->configuration(), smallBoard().configuration);
}

TEST(HidBoards, KernelsDescriptorIsThePublishedOne) {
  MockUsb usb;
  const MockBoard mock(usb, namedBoard("PALP-1"), 1, 0);
  const std::vector<std::uint8_t> descriptor = reportDescriptorOf(hidBoards()[0]);
  EXPECT_EQ(descriptor, std::vector<std::uint8_t>(reportDescriptor().begin(), reportDescriptor().end()));
}

TEST(HidBoards, ConfiguresAndCommandsTheBoard) {
  MockUsb usb;
  MockBoard mock(usb, namedBoard("PALP-1"), 1, 0);
  const auto source = openHidBoard(hidBoards()[0]);
  BoardConfiguration wanted = source->configuration();
  wanted.mode = BoardMode::SingleRow;
  EXPECT_TRUE(source->configure(wanted));
  EXPECT_EQ(source->configuration().mode, BoardMode::SingleRow);
  EXPECT_EQ(source->configuration().generation, 1);
  wanted.rate_Hz = 0;
  EXPECT_FALSE(source->configure(wanted));
  EXPECT_TRUE(source->send({Opcode::Stop, 9, {}}));
  EXPECT_EQ(mock.commands(), 1);
  mock.startStreaming();
  RawReport report;
  ASSERT_EQ(source->read(report, kPatience), ReportSource::Outcome::Read);
  const auto event = decodeInput(report.bytes, source->info());
  EXPECT_EQ(std::get<BoardEvent>(event).tag, 9);
}

TEST(HidBoards, StreamsWithoutLoss) {
  MockUsb usb;
  MockBoard mock(usb, namedBoard("PALP-1"), 1, 0);
  const auto source = openHidBoard(hidBoards()[0]);
  RawReport report;
  EXPECT_EQ(source->read(report, std::chrono::milliseconds(20)), ReportSource::Outcome::Nothing);
  mock.startStreaming();
  FrameAssembler assembler(source->info(), source->configuration());
  while (assembler.counts().reports < 900) {
    ASSERT_EQ(source->read(report, kPatience), ReportSource::Outcome::Read);
    assembler.add(report.bytes, report.hostTime_s, [](const BoardFrame&) {});
  }
  EXPECT_EQ(assembler.counts().lost + assembler.counts().bad, 0U);
  EXPECT_EQ(assembler.counts().frames, 100U);
}

TEST(HidBoards, DropsWhatWasQueuedBeforeItWasOpened) {
  MockUsb usb;
  MockBoard mock(usb, namedBoard("PALP-1"), 1, 0);
  mock.startStreaming();
  std::this_thread::sleep_for(std::chrono::milliseconds(50)); // fills the queue
  mock.stopStreaming();
  const auto source = openHidBoard(hidBoards()[0]);
  RawReport report;
  EXPECT_EQ(source->read(report, std::chrono::milliseconds(20)), ReportSource::Outcome::Nothing);
}

TEST(HidBoards, AReportOfAnotherLengthArrivesAsItIs) {
  BoardSettings settings = smallBoard();
  settings.faults.truncateEvery = 5;
  MockUsb usb;
  MockBoard mock(usb, boardWith(settings), 1, 0);
  const auto source = openHidBoard(hidBoards()[0]);
  mock.startStreaming();
  FrameAssembler assembler(source->info(), source->configuration());
  RawReport report;
  while (assembler.counts().reports < 50) {
    ASSERT_EQ(source->read(report, kPatience), ReportSource::Outcome::Read);
    assembler.add(report.bytes, report.hostTime_s, [](const BoardFrame&) {});
  }
  EXPECT_EQ(assembler.counts().bad, 10U);
}

TEST(HidBoards, TellsTwoBoardsApart) {
  MockUsb usb;
  const MockBoard one(usb, namedBoard("PALP-1"), 1, 0);
  const MockBoard two(usb, namedBoard("PALP-2"), 2, 1);
  const std::vector<HidBoard> boards = hidBoards();
  ASSERT_EQ(boards.size(), 2U);
  for (const HidBoard& board : boards) EXPECT_EQ(openHidBoard(board)->info().serial, board.serial);
  EXPECT_NE(boards[0].path, boards[1].path);
}

TEST(HidBoards, TwoBoardsOfOneSerialAreToldApartByPath) {
  MockUsb usb;
  const MockBoard one(usb, namedBoard("PALP-1"), 1, 0);
  const MockBoard two(usb, namedBoard("PALP-1"), 2, 1);
  const std::vector<HidBoard> boards = hidBoards();
  ASSERT_EQ(boards.size(), 2U);
  EXPECT_EQ(boards[0].path, "/dev/hidraw0");
  EXPECT_EQ(boards[1].path, "/dev/hidraw1");
}

TEST(HidBoards, ASecondProgramMayReadToo) {
  MockUsb usb;
  const MockBoard mock(usb, namedBoard("PALP-1"), 1, 0);
  const auto first = openHidBoard(hidBoards()[0]);
  EXPECT_EQ(openHidBoard(hidBoards()[0])->info(), first->info());
}

TEST(HidBoards, SaysHowToGetThePermission) {
  MockUsb usb;
  const MockBoard mock(usb, namedBoard("PALP-1"), 1, 0);
  const HidBoard board = hidBoards()[0];
  ASSERT_EQ(::chmod(mock.file().c_str(), 0), 0);
  std::string sentence;
  {
    const OrdinaryUser user;
    EXPECT_FALSE(hidBoards()[0].permission);
    EXPECT_THROW(openHidBoard(board), BoardPermissionError);
    sentence = refusal([&] { openHidBoard(board); });
  }
  for (const char* part : {"PALP-1", "/dev/hidraw0", "no permission", "70-palp-board.rules", "udevadm"})
    EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
}

TEST(HidBoards, ABoardThatIsGoneCannotBeOpened) {
  MockUsb usb;
  HidBoard board;
  {
    MockBoard mock(usb, namedBoard("PALP-1"), 1, 0);
    board = hidBoards()[0];
    mock.unplug();
  }
  EXPECT_NE(refusal([&] { openHidBoard(board); }).find("cannot be opened"), std::string::npos);
}

TEST(HidBoards, RefusesABoardOfAnotherProtocol) {
  BoardSettings settings = smallBoard();
  settings.info.protocol = 0x0200;
  MockUsb usb;
  const MockBoard mock(usb, boardWith(settings), 1, 0);
  EXPECT_NE(refusal([] { openHidBoard(hidBoards()[0]); }).find("another protocol"), std::string::npos);
}

TEST(HidBoards, TellsThatItWasUnpluggedAndComesBackUnderAnotherPath) {
  MockUsb usb;
  Hotplug hotplug;
  ASSERT_TRUE(hotplug.byEvents());
  auto mock = std::make_unique<MockBoard>(usb, namedBoard("PALP-1"), 1, 0);
  EXPECT_TRUE(waitForChange(hotplug));
  const auto source = openHidBoard(hidBoards()[0]);
  mock->startStreaming();
  RawReport report;
  for (int i = 0; i < 13; ++i) ASSERT_EQ(source->read(report, kPatience), ReportSource::Outcome::Read); // in mid-frame
  mock->unplug();
  while (source->read(report, kPatience) == ReportSource::Outcome::Read) {
  }
  EXPECT_EQ(source->read(report, kPatience), ReportSource::Outcome::Gone);
  EXPECT_NE(source->reason().find("/dev/hidraw0 was unplugged"), std::string::npos);
  EXPECT_FALSE(source->send({Opcode::Stop, 1, {}}));
  EXPECT_TRUE(waitForChange(hotplug));
  EXPECT_TRUE(hidBoards().empty());
  mock.reset();
  MockBoard again(usb, namedBoard("PALP-1"), 1, 3);
  again.startStreaming();
  ASSERT_EQ(hidBoards().size(), 1U);
  EXPECT_EQ(hidBoards()[0].path, "/dev/hidraw3");
  EXPECT_EQ(openHidBoard(hidBoards()[0])->read(report, kPatience), ReportSource::Outcome::Read);
}

} // namespace
} // namespace palp
