#include "io/board/RecordingReader.h"
#include "io/board/RecordingWriter.h"

#include "io/AtomicFile.h"
#include "io/board/ReplaySource.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"
#include "tests/io/board/SmallBoard.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sys/resource.h>

#include <csignal>
#include <sstream>

namespace palp {
namespace {

using Kind = RecordingEntry::Kind;

RecordingHead smallHead() {
  return {smallBoard().info, smallBoard().configuration, "SMALL-1 at /dev/hidraw0", "0123456789abcdef", 1'700'000'000};
}

/// Waits for the writer's thread, 10 s at most.
template <class Condition> void waitUntil(const Condition& condition) {
  for (int i = 0; i < 500 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

/// 30 reports at 1000/s with a mark after the tenth.
std::vector<Bytes> record(const std::filesystem::path& path) {
  VirtualBoard board = boardWith(smallBoard());
  const std::vector<Bytes> reports = reportsOf(board, 30);
  RecordingWriter writer(path, smallHead(), true);
  const std::string mark = "pressed";
  for (std::size_t i = 0; i < reports.size(); ++i) {
    writer.append(Kind::Raw, 100 + 1e-3 * static_cast<double>(i), reports[i]);
    if (i == 9) writer.append(Kind::Mark, 100.0095, {reinterpret_cast<const std::uint8_t*>(mark.data()), mark.size()});
  }
  waitUntil([&] { return writer.reports() == 30; });
  EXPECT_EQ(writer.reports(), 30U);
  EXPECT_EQ(writer.dropped(), 0U);
  EXPECT_EQ(writer.failure(), "");
  return reports;
}

TEST(Recording, ReadsBackWhatWasWritten) {
  const TemporaryFolder folder;
  const std::vector<Bytes> reports = record(folder / "a.palprec");
  RecordingReader reader(folder / "a.palprec");
  EXPECT_EQ(reader.head().info, smallBoard().info);
  EXPECT_EQ(reader.head().configuration, smallBoard().configuration);
  EXPECT_EQ(reader.head().source, "SMALL-1 at /dev/hidraw0");
  EXPECT_EQ(reader.head().networkFingerprint, "0123456789abcdef");
  EXPECT_EQ(reader.head().startedUnix_s, 1'700'000'000);
  std::vector<Bytes> back;
  std::string mark;
  while (const auto entry = reader.next()) {
    if (entry->kind == Kind::Raw) back.push_back(entry->bytes);
    if (entry->kind == Kind::Mark) mark.assign(entry->bytes.begin(), entry->bytes.end());
  }
  EXPECT_EQ(back, reports);
  EXPECT_EQ(mark, "pressed");
  EXPECT_FALSE(reader.cutOff());
}

TEST(Recording, KeepsTheReadOutOfItsBoard) {
  const TemporaryFolder folder;
  RecordingHead head;
  head.info = smallBoard().info;
  head.info.readout = Readout::RowsGrounded;
  head.configuration = smallBoard().configuration;
  { const RecordingWriter writer(folder / "a.palprec", head, false); }
  EXPECT_EQ(RecordingReader(folder / "a.palprec").head().info.readout, Readout::RowsGrounded);
}

TEST(Recording, OpensToItsLastWholeReportWhereverItIsCutOff) {
  const TemporaryFolder folder;
  record(folder / "a.palprec");
  const std::string whole = readFile(folder / "a.palprec");
  const std::size_t entries = whole.size() - 30 * 76 - (12 + 7); // head
  for (std::size_t length = 0; length < whole.size(); ++length) {
    auto stream = std::make_unique<std::istringstream>(whole.substr(0, length));
    if (length < entries) {
      EXPECT_FALSE(refusal([&] { RecordingReader(std::move(stream), "a"); }).empty()) << length;
      continue;
    }
    RecordingReader reader(std::move(stream), "a");
    std::size_t count = 0;
    while (const auto entry = reader.next()) count += entry->kind == Kind::Raw;
    const std::size_t body = length - entries;
    EXPECT_EQ(count, body < 760 + 19 ? std::min<std::size_t>(body / 76, 10) : (body - 19) / 76) << length;
  }
}

TEST(Recording, HoldsTheLargestTareToTheLastBit) {
  const TemporaryFolder folder;
  Tare tare{Eigen::MatrixXd::Random(32, 255) * 100 + Eigen::MatrixXd::Constant(32, 255, 1000), 5.1e-6, 25};
  {
    RecordingWriter writer(folder / "a", smallHead(), false);
    writer.append(Kind::Tare, 1, encode(tare));
    writer.append(Kind::Tare, 2, {});
  }
  RecordingReader reader(folder / "a");
  const auto first = reader.next(), second = reader.next();
  ASSERT_TRUE(first && second);
  const auto back = decodeTare(first->bytes, 32, 255);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->rest_ohm, tare.rest_ohm);
  EXPECT_EQ(back->noise, tare.noise);
  EXPECT_EQ(back->frames, 25);
  EXPECT_FALSE(decodeTare(first->bytes, 255, 32)) << "of another board";
  EXPECT_FALSE(decodeTare(second->bytes, 32, 255)) << "no tare any more";
  tare.rest_ohm(3, 7) = std::nan("");
  EXPECT_FALSE(decodeTare(encode(tare), 32, 255));
}

TEST(Recording, IsPlayedWithTheTareAndTheMarkOfEachPlace) {
  const TemporaryFolder folder;
  VirtualBoard board = boardWith(smallBoard());
  const std::vector<Bytes> reports = reportsOf(board, 30);
  const BoardInfo info = smallBoard().info;
  const Tare tare{Eigen::MatrixXd::Constant(info.rowWires, info.columnWires, 512.5), 1e-5, 3};
  const std::string words = "poke";
  {
    RecordingWriter writer(folder / "a", smallHead(), false);
    for (std::size_t i = 0; i < reports.size(); ++i) {
      if (i == 10) writer.append(Kind::Tare, 100.0099, encode(tare));
      if (i == 15)
        writer.append(Kind::Mark, 100.0149, {reinterpret_cast<const std::uint8_t*>(words.data()), words.size()});
      if (i == 20) writer.append(Kind::Tare, 100.0199, {});
      writer.append(Kind::Raw, 100 + 1e-3 * static_cast<double>(i), reports[i]);
    }
  }
  auto control = std::make_shared<ReplayControl>();
  control->speed = 0;
  ReplaySource source(folder / "a", control);
  RawReport report;
  const auto tareAt = [&](double at_s) {
    control->seek(at_s);
    EXPECT_EQ(source.read(report, std::chrono::milliseconds(10)), ReportSource::Outcome::Read);
    return source.tare() ? source.tare()->rest_ohm(0, 0) : 0;
  };
  EXPECT_EQ(tareAt(0.015), 512.5);
  EXPECT_EQ(tareAt(0.002), 0) << "it was not tared yet";
  EXPECT_EQ(tareAt(0.012), 512.5);
  EXPECT_EQ(tareAt(0.025), 0) << "the tare was taken away";
  ASSERT_EQ(control->marks().size(), 1U);
  tareAt(control->marks()[0].at_s);
  EXPECT_EQ(source.mark(), "poke");
  EXPECT_TRUE(source.markFollowsJump()) << "gone to the mark itself";
  tareAt(0.020);
  EXPECT_EQ(source.mark(), "poke");
  EXPECT_FALSE(source.markFollowsJump()) << "it began before";
}

TEST(Recording, IsOnDiskASecondLaterWithoutAnEnd) {
  const TemporaryFolder folder;
  VirtualBoard board = boardWith(smallBoard());
  RecordingWriter writer(folder / "a", smallHead(), false);
  writer.append(Kind::Raw, 1, reportsOf(board, 1)[0]);
  waitUntil([&] { return RecordingReader(folder / "a").next().has_value(); });
  EXPECT_TRUE(RecordingReader(folder / "a").next());
}

TEST(Recording, RefusesWhatIsNone) {
  const TemporaryFolder folder;
  put(folder / "text", "hello, this is no recording at all");
  put(folder / "long", std::string("PALPREC1\xff\xff\xff\x7f") + std::string(100, ' '));
  put(folder / "json", std::string("PALPREC1\x02\0\0\0{}", 14));
  EXPECT_NE(refusal([&] { RecordingReader(folder / "text"); }).find("not a recording"), std::string::npos);
  EXPECT_NE(refusal([&] { RecordingReader(folder / "long"); }).find("head"), std::string::npos);
  EXPECT_NE(refusal([&] { RecordingReader(folder / "json"); }).find("palp_recording"), std::string::npos);
  EXPECT_NE(refusal([&] { RecordingReader(folder / "none"); }).find("cannot be read"), std::string::npos);
  EXPECT_NE(refusal([&] { RecordingReader(folder.path()); }).find("cannot be read"), std::string::npos);
}

TEST(Recording, RefusesToOverwriteAndSaysThatTheDiskIsFull) {
  const TemporaryFolder folder;
  put(folder / "a", "precious");
  EXPECT_NE(refusal([&] { RecordingWriter(folder / "a", smallHead(), false); }).find("--force"), std::string::npos);
  EXPECT_NE(refusal([&] { RecordingWriter("/dev/full", smallHead(), true); }).find("No space"), std::string::npos);
}

TEST(Recording, IsWrittenWhereALinkLeads) {
  const TemporaryFolder folder;
  std::filesystem::create_symlink("far.palprec", folder / "near.palprec");
  EXPECT_EQ(record(folder / "near.palprec").size(), 30U);
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "near.palprec"));
  EXPECT_TRUE(RecordingReader(folder / "far.palprec").next());
}

/// Files of this process end at a size, as on a full disk.
class FileSizeLimit {
public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST(Recording, ThatIsReplacedStaysWhereTheNextOneCannotBegin) {
  const TemporaryFolder folder;
  put(folder / "a", "precious");
  const FileSizeLimit limit(100); // less than the head
  EXPECT_NE(refusal([&] { RecordingWriter(folder / "a", smallHead(), true); }).find("File too large"),
            std::string::npos);
  EXPECT_EQ(readFile(folder / "a"), "precious");
}

TEST(Recording, CountsWhatWasWrittenAndNotWhatWasQueued) {
  const TemporaryFolder folder;
  VirtualBoard board = boardWith(smallBoard());
  const std::vector<Bytes> reports = reportsOf(board, 100);
  const FileSizeLimit limit(4000); // the head and some 40 entries of 76 bytes
  RecordingWriter writer(folder / "a", smallHead(), false);
  for (const Bytes& report : reports) writer.append(Kind::Raw, 1, report);
  waitUntil([&] { return !writer.failure().empty(); });
  EXPECT_NE(writer.failure().find("File too large"), std::string::npos) << writer.failure();
  EXPECT_EQ(writer.reports() + writer.dropped(), 100U);
  std::size_t there = 0;
  RecordingReader reader(folder / "a");
  while (reader.next()) ++there;
  EXPECT_FALSE(reader.cutOff()) << "it ends with a whole report";
  EXPECT_LT(there, 100U);
  EXPECT_EQ(writer.reports(), there);
}

std::size_t replayed(ReplaySource& source) {
  RawReport report;
  std::size_t count = 0;
  while (source.read(report, std::chrono::milliseconds(50)) == ReportSource::Outcome::Read) ++count;
  return count;
}

TEST(ReplaySource, GivesTheReportsAgainWithTheirTimes) {
  const TemporaryFolder folder;
  const std::vector<Bytes> reports = record(folder / "a");
  auto control = std::make_shared<ReplayControl>();
  control->speed = 0;
  ReplaySource source(folder / "a", control);
  RawReport report;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    ASSERT_EQ(source.read(report, std::chrono::milliseconds(1)), ReportSource::Outcome::Read);
    EXPECT_EQ(report.bytes, reports[i]);
    EXPECT_EQ(report.hostTime_s, 100 + 1e-3 * static_cast<double>(i));
  }
  EXPECT_EQ(source.mark(), "pressed");
  EXPECT_EQ(source.read(report, std::chrono::milliseconds(1)), ReportSource::Outcome::End);
}

TEST(ReplaySource, PlaysInItsOwnTimeOrFaster) {
  const TemporaryFolder folder;
  record(folder / "a");
  for (const double speed : {1.0, 4.0}) {
    auto control = std::make_shared<ReplayControl>();
    control->speed = speed;
    ReplaySource source(folder / "a", control);
    const double start_s = hostClock_s();
    EXPECT_EQ(replayed(source), 30U);
    EXPECT_GE(hostClock_s() - start_s, 0.9 * 0.029 / speed); // never ahead of its time; how late is the machine's
  }
}

TEST(ReplaySource, GoesToAnyTimeOfTheRecordingAndPlaysALoop) {
  const TemporaryFolder folder;
  const std::vector<Bytes> reports = record(folder / "a");
  auto control = std::make_shared<ReplayControl>();
  control->speed = 0;
  ReplaySource source(folder / "a", control);
  EXPECT_NEAR(control->length_s, 0.029, 1e-9);
  const auto next = [&] {
    RawReport report;
    EXPECT_EQ(source.read(report, std::chrono::milliseconds(1)), ReportSource::Outcome::Read);
    return report.hostTime_s - 100;
  };
  control->seek(0.0195); // between two reports
  EXPECT_NEAR(next(), 0.020, 1e-9);
  EXPECT_TRUE(source.jumped());
  EXPECT_FALSE(source.jumped());
  control->seek(0.003); // back
  EXPECT_NEAR(next(), 0.003, 1e-9);
  EXPECT_NEAR(control->position_s, 0.003, 1e-9);
  EXPECT_EQ(source.mark(), "") << "the mark lies ahead again";
  EXPECT_EQ(replayed(source), 26U);
  control->seek(1e9); // beyond its end: the last report
  EXPECT_NEAR(next(), 0.029, 1e-9);

  control->loopFrom_s = 0.0095;
  control->loopTo_s = 0.0125;
  control->loop = true;
  std::vector<int> round;
  for (int k = 0; k < 7; ++k) round.push_back(static_cast<int>(std::lround(1e3 * next())));
  EXPECT_EQ(round, (std::vector<int>{10, 11, 12, 10, 11, 12, 10}));
}

TEST(ReplaySource, ReadsThePastOfAPlaceFirstAlsoWhereItIsHeld) {
  const TemporaryFolder folder;
  const std::vector<Bytes> reports = record(folder / "a");
  auto control = std::make_shared<ReplayControl>();
  control->past_s = 0.0095;
  control->paused = true;
  ReplaySource source(folder / "a", control);
  RawReport report;
  control->seek(0.0195);
  std::vector<int> past;
  while (source.read(report, std::chrono::milliseconds(1)) == ReportSource::Outcome::Read && source.inPast()) {
    past.push_back(static_cast<int>(std::lround(1e3 * (report.hostTime_s - 100))));
    EXPECT_TRUE(source.past(report.hostTime_s));
    EXPECT_NEAR(control->position_s, 0.0195, 1e-9) << "the place that was gone to";
  }
  EXPECT_EQ(past, (std::vector<int>{10, 11, 12, 13, 14, 15, 16, 17, 18, 19}));
  EXPECT_NEAR(report.hostTime_s, 100.020, 1e-9) << "then the place itself";
  EXPECT_FALSE(source.past(report.hostTime_s));
  EXPECT_EQ(control->steps, 1) << "of which one frame is shown";
  control->steps = 0;
  EXPECT_EQ(source.read(report, std::chrono::milliseconds(1)), ReportSource::Outcome::Nothing) << "and it stands";

  control->seek(0.004); // less past than asked for
  ASSERT_EQ(source.read(report, std::chrono::milliseconds(1)), ReportSource::Outcome::Read);
  EXPECT_NEAR(report.hostTime_s, 100, 1e-9);
  EXPECT_TRUE(source.inPast());
}

TEST(ReplaySource, GoesBackByAFrameWhereReportsCameInBursts) {
  const TemporaryFolder folder;
  VirtualBoard board = boardWith(smallBoard());
  const std::vector<Bytes> reports = reportsOf(board, 90); // ten frames
  const auto time_s = [](std::size_t i) { return 100 + 0.02 * static_cast<double>(i / 16) + 1e-6 * double(i); };
  {
    RecordingWriter writer(folder / "a", smallHead(), true);
    for (std::size_t i = 0; i < reports.size(); ++i) writer.append(Kind::Raw, time_s(i), reports[i]);
    waitUntil([&] { return writer.reports() == 90; });
  }
  auto control = std::make_shared<ReplayControl>();
  control->speed = 0;
  ReplaySource source(folder / "a", control);
  FrameAssembler assembler(smallBoard().info, smallBoard().configuration);
  const auto nextFrame = [&] {
    std::optional<BoardFrame> shown;
    RawReport report;
    while (!shown && source.read(report, std::chrono::milliseconds(1)) == ReportSource::Outcome::Read) {
      if (source.jumped()) assembler.restart();
      assembler.add(report.bytes, report.hostTime_s, [&](const BoardFrame& frame) { shown = frame; });
    }
    EXPECT_TRUE(shown && shown->complete);
    return shown.value_or(BoardFrame());
  };
  BoardFrame frame;
  for (int k = 0; k < 8; ++k) frame = nextFrame();
  const auto first = frame.number - 7;
  for (int k = 6; k >= 0; --k) {
    control->seekFrameBefore(frame.hostTime_s);
    EXPECT_TRUE(control->sought());
    frame = nextFrame();
    EXPECT_EQ(frame.number, first + static_cast<std::uint64_t>(k));
  }
  control->seekFrameBefore(frame.hostTime_s);
  EXPECT_EQ(nextFrame().number, first) << "nothing lies before";

  control->paused = true;
  control->seekFrameBefore(time_s(89));
  RawReport report;
  EXPECT_EQ(source.read(report, std::chrono::milliseconds(1)), ReportSource::Outcome::Read);
  EXPECT_EQ(control->steps, 1) << "the frame there is shown, then it stands";
}

TEST(ReplaySource, StandsStillWhilePaused) {
  const TemporaryFolder folder;
  record(folder / "a");
  auto control = std::make_shared<ReplayControl>();
  control->paused = true;
  ReplaySource source(folder / "a", control);
  RawReport report;
  EXPECT_EQ(source.read(report, std::chrono::milliseconds(1)), ReportSource::Outcome::Nothing);
  control->steps = 1;
  EXPECT_EQ(source.read(report, std::chrono::milliseconds(1)), ReportSource::Outcome::Read);
  control->paused = false;
  EXPECT_EQ(replayed(source), 29U);
}

TEST(Recording, AnErrorInTheWritersThreadEndsTheRecordingAndNotTheProgram) {
  const TemporaryFolder folder;
  VirtualBoard board = boardWith(smallBoard());
  int blocks = 0;
  RecordingWriter writer(folder / "a.palprec", smallHead(), false, [&](int file, std::string_view bytes) {
    if (++blocks == 2) throw std::bad_alloc(); // the first is the head
    return RecordingWriter::writtenOf(file, bytes);
  });
  for (const Bytes& report : reportsOf(board, 5)) writer.append(Kind::Raw, 100, report);
  writer.finish();
  EXPECT_EQ(writer.failure(), (folder / "a.palprec").string() + ": can no longer be written: std::bad_alloc");
  EXPECT_EQ(writer.reports(), 0U);
  EXPECT_EQ(writer.dropped(), 5U);
}

} // namespace
} // namespace palp
