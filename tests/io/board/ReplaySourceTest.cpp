// Recordings that are long, that change their configuration, and that are damaged.

#include "io/board/ReplaySource.h"
#include "io/board/RecordingReader.h"
#include "io/board/RecordingWriter.h"

#include "io/AtomicFile.h"
#include "tests/io/TemporaryFolder.h"
#include "tests/io/board/SmallBoard.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <map>

#include <random>
#include <set>
#include <sstream>

namespace palp {
namespace {

using EntryKind = RecordingEntry::Kind;
constexpr double kBegin_s = 100;
constexpr std::chrono::milliseconds kNoTime{0};

/// One after another: so many reports of each of these configurations.
void recordConfigurations(const std::filesystem::path& path, const std::vector<BoardConfiguration>& configurations,
                          std::size_t reportsOfEach) {
  BoardSettings settings = smallBoard();
  RecordingWriter writer(path, {settings.info, settings.configuration, "SMALL-1", "", 1}, true);
  double time_s = kBegin_s;
  for (std::size_t part = 0; part < configurations.size(); ++part) {
    settings.configuration = configurations[part];
    if (part > 0) writer.append(EntryKind::Configuration, time_s, encode(settings.configuration));
    VirtualBoard board = boardWith(settings);
    const std::string mark = "part " + std::to_string(part);
    writer.append(EntryKind::Mark, time_s, {reinterpret_cast<const std::uint8_t*>(mark.data()), mark.size()});
    if (part == 1) writer.append(EntryKind::Tare, time_s, encode(Tare{Eigen::MatrixXd::Ones(3, 32), 1e-5, 3}));
    for (const Bytes& report : reportsOf(board, reportsOfEach, 1000 + 1'000'000 * part))
      writer.append(EntryKind::Raw, time_s += 1.0 / settings.configuration.rate_Hz, report);
  }
}

std::vector<BoardConfiguration> fourConfigurations() {
  BoardConfiguration first = smallBoard().configuration, alone = first, fast = first, last = first;
  alone.generation = 1;
  alone.mode = BoardMode::SingleRow;
  alone.rowMask = 0b10;
  fast.generation = 2;
  fast.rate_Hz = 4000;
  last.generation = 3;
  last.rowMask = 0b101;
  return {first, alone, fast, last};
}

std::shared_ptr<ReplayControl> asFastAsItCan() {
  auto control = std::make_shared<ReplayControl>();
  control->speed = 0;
  return control;
}

TEST(ReplayOfChanges, EachReportComesWithTheConfigurationThatWasInForce) {
  const TemporaryFolder folder;
  recordConfigurations(folder / "a", fourConfigurations(), 90);
  const std::vector<BoardConfiguration> configurations = fourConfigurations();
  ReplaySource source(folder / "a", asFastAsItCan());
  FrameAssembler assembler(smallBoard().info, source.configuration());
  RawReport report;
  std::array<int, 4> frames{};
  for (std::size_t i = 0; i < 360; ++i) {
    ASSERT_EQ(source.read(report, kNoTime), ReportSource::Outcome::Read);
    ASSERT_EQ(source.configuration(), configurations[i / 90]) << i;
    if (!(source.configuration() == assembler.configuration())) assembler.setConfiguration(source.configuration());
    assembler.add(report.bytes, report.hostTime_s, [&](const BoardFrame& frame) { frames[i / 90] += frame.complete; });
  }
  EXPECT_EQ(frames, (std::array<int, 4>{10, 30, 10, 15})) << "9, 3, 9 and 6 reports a frame";
  EXPECT_EQ(assembler.counts().stale, 0U);
}

TEST(ReplayLoop, OverAPauseOfTheRecordingDoesNotHoldTheReplay) {
  const TemporaryFolder folder;
  const BoardSettings settings = smallBoard();
  {
    RecordingWriter writer(folder / "a", {settings.info, settings.configuration, "SMALL-1", "", 1}, true);
    for (const double begin_s : {0., 3.}) { // the board was out between them
      VirtualBoard board = boardWith(settings);
      double time_s = kBegin_s + begin_s;
      for (const Bytes& report : reportsOf(board, 50, static_cast<std::uint64_t>(1000 + 1e6 * begin_s)))
        writer.append(EntryKind::Raw, time_s += 1e-3, report);
    }
  }
  auto control = asFastAsItCan();
  control->loopFrom_s = 1;
  control->loopTo_s = 2;
  control->loop = true;
  ReplaySource source(folder / "a", control);
  int reports = 0;
  for (RawReport report; reports < 1000 && source.read(report, kNoTime) == ReportSource::Outcome::Read;) ++reports;
  EXPECT_EQ(reports, 100) << "each once";
}

/// What lies at a place of the recording that was gone to.
struct Found {
  double time_s = 0;
  Bytes bytes;
  BoardConfiguration configuration;
  std::string mark;
  bool tared = false;
  bool operator==(const Found&) const = default;
};

Found at(ReplaySource& source, ReplayControl& control, double place_s) {
  control.seek(place_s);
  RawReport report;
  while (source.read(report, kNoTime) == ReportSource::Outcome::Nothing) { // it is measured
  }
  return {report.hostTime_s, report.bytes, source.configuration(), source.mark(), source.tare() != nullptr};
}

TEST(ReplayOfALongRecording, GoesToAnyPlaceAlsoWhileItIsStillMeasured) {
  const TemporaryFolder folder;
  const std::size_t each = 12'000; // places to go on from lie every 16,384 reports
  recordConfigurations(folder / "a", fourConfigurations(), each);
  auto control = asFastAsItCan();
  ReplaySource whole(folder / "a", control);
  std::vector<Found> all;
  for (RawReport report; whole.read(report, kNoTime) == ReportSource::Outcome::Read;)
    all.push_back({report.hostTime_s, report.bytes, whole.configuration(), whole.mark(), whole.tare() != nullptr});
  ASSERT_EQ(all.size(), 4 * each);
  std::mt19937 engine(3);
  for (int k = 0; k < 3; ++k) {
    auto early = asFastAsItCan();
    ReplaySource source(folder / "a", early, 100);
    EXPECT_NEAR(early->length_s, control->length_s, 1e-6) << "is known at once";
    for (int jump = 0; jump < 4; ++jump) {
      const std::size_t wanted = engine() % all.size();
      const double place_s = all[wanted].time_s - all[0].time_s - 1e-4; // between two reports
      EXPECT_EQ(at(source, *early, place_s), all[wanted]) << wanted;
      EXPECT_EQ(at(whole, *control, place_s), all[wanted]) << wanted;
    }
    at(source, *early, 1e9);
    EXPECT_EQ(early->marks(), control->marks());
  }
  EXPECT_EQ(control->marks().size(), 4U);
}

TEST(ReplayOfALongRecording, GoesBackByAFrameAcrossThePlacesToGoOnFrom) {
  const TemporaryFolder folder;
  recordConfigurations(folder / "a", {smallBoard().configuration}, 33'000);
  auto control = asFastAsItCan();
  ReplaySource source(folder / "a", control);
  for (const std::size_t report : {16'384UL, 16'385UL, 16'390UL, 32'770UL}) {
    const std::size_t frame = report / 9; // that this report is of
    control->seekFrameBefore(kBegin_s + 1e-3 * static_cast<double>(9 * frame + 9) + 1e-4);
    RawReport found;
    ASSERT_EQ(source.read(found, kNoTime), ReportSource::Outcome::Read);
    EXPECT_NEAR(found.hostTime_s, kBegin_s + 1e-3 * static_cast<double>(9 * (frame - 1) + 1), 1e-6) << report;
  }
}

/// A recording as bytes, with the place of each entry.
struct Written {
  std::string bytes;
  std::vector<std::size_t> begins; ///< of the entries
  std::map<std::size_t, RecordingEntry> entries;
};

Written writtenOf(const std::filesystem::path& path) {
  Written written;
  RecordingReader reader(path);
  std::size_t begin = reader.place();
  for (RecordingEntry entry; reader.next(entry); begin = reader.place()) {
    written.begins.push_back(begin);
    written.entries[begin] = entry;
  }
  written.bytes = readFile(path);
  return written;
}

/// Each entry that has no spoilt byte is read again, at its time.
void expectTheRest(const Written& written, const std::set<std::size_t>& spoilt, const std::string& how) {
  std::string bytes = written.bytes;
  std::mt19937 engine(static_cast<unsigned>(spoilt.size()));
  for (const std::size_t at : spoilt) bytes[at] = static_cast<char>(bytes[at] ^ (1 + engine() % 255));
  RecordingReader reader(std::make_unique<std::istringstream>(bytes), "a");
  std::vector<RecordingEntry> read;
  for (RecordingEntry entry; reader.next(entry);) read.push_back(entry);
  EXPECT_FALSE(reader.cutOff()) << how;
  auto next = read.begin();
  for (const auto& [begin, entry] : written.entries) {
    const auto hit = spoilt.lower_bound(begin);
    if (hit != spoilt.end() && *hit < begin + 12 + entry.bytes.size()) continue;
    next = std::find_if(next, read.end(), [&, &whole = entry](const RecordingEntry& found) {
      return found.kind == whole.kind && found.bytes == whole.bytes;
    });
    ASSERT_NE(next, read.end()) << how << ": the entry at " << begin << " is lost";
    EXPECT_NEAR(next->hostTime_s, entry.hostTime_s, 5e-3) << how;
  }
}

TEST(DamagedRecording, LosesTheEntriesThatHaveSpoiltBytesAndNoOthers) {
  const TemporaryFolder folder;
  recordConfigurations(folder / "a", fourConfigurations(), 300);
  const Written written = writtenOf(folder / "a");
  ASSERT_EQ(written.begins.size(), 4 * 300 + 4 + 3 + 1U);
  const std::size_t from = written.begins[1], length = written.bytes.size() - 600 - from;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 engine(seed);
    std::set<std::size_t> together, apart;
    const std::size_t begin = from + engine() % length;
    for (std::size_t k = 0; k < 200; ++k) together.insert(begin + k);
    for (std::size_t k = 0; k < 40; ++k) apart.insert(from + engine() % length);
    expectTheRest(written, together, "200 together, seed " + std::to_string(seed));
    expectTheRest(written, apart, "40 apart, seed " + std::to_string(seed));
  }
}

TEST(DamagedRecording, IsPlayedToItsEndAndSaysWhatWasLeftOut) {
  const TemporaryFolder folder;
  recordConfigurations(folder / "a", {smallBoard().configuration}, 2000);
  std::string bytes = readFile(folder / "a");
  for (std::size_t k = 0; k < 200; ++k) bytes[50'000 + k] = '\x5a';
  put(folder / "a", bytes);
  auto control = asFastAsItCan();
  ReplaySource source(folder / "a", control);
  EXPECT_NEAR(control->length_s, 1.999, 1e-9);
  std::size_t reports = 0;
  RawReport report;
  EXPECT_EQ(source.reason(), "");
  while (source.read(report, kNoTime) == ReportSource::Outcome::Read) ++reports;
  EXPECT_GE(reports, 1996U);
  EXPECT_NE(source.reason().find(" bytes are damaged"), std::string::npos) << source.reason();
  EXPECT_EQ(source.reason().find("cut off"), std::string::npos) << source.reason();
}

TEST(DamagedRecording, AHoleOfZerosOrTextIsPassedOver) {
  const TemporaryFolder folder;
  recordConfigurations(folder / "a", {smallBoard().configuration}, 400);
  const Written written = writtenOf(folder / "a");
  const std::size_t middle = written.begins[200];
  for (const char filler : {'\0', '\x01', ' ', '\xff'}) {
    const std::string bytes =
        written.bytes.substr(0, middle) + std::string(100'000, filler) + written.bytes.substr(middle);
    RecordingReader reader(std::make_unique<std::istringstream>(bytes), "a");
    std::size_t reports = 0;
    for (RecordingEntry entry; reader.next(entry);) reports += entry.kind == EntryKind::Raw;
    EXPECT_EQ(reports, 400U) << static_cast<int>(filler);
    EXPECT_EQ(reader.spoiltBytes(), 100'000U);
  }
}

TEST(DamagedRecording, ASpoiltTimeMovesNoOtherReport) {
  const TemporaryFolder folder;
  recordConfigurations(folder / "a", {smallBoard().configuration}, 400);
  const Written written = writtenOf(folder / "a");
  for (const double time_s : {1e300, -1e9, 0.0, kBegin_s + 0.5, kBegin_s - 0.5, kBegin_s + 7200}) {
    std::string bytes = written.bytes;
    std::memcpy(bytes.data() + written.begins[100] + 4, &time_s, sizeof time_s);
    put(folder / "b", bytes);
    auto control = asFastAsItCan();
    ReplaySource source(folder / "b", control);
    EXPECT_NEAR(control->length_s, 0.399, 1e-9) << time_s;
    double before_s = 0;
    for (RawReport report; source.read(report, kNoTime) == ReportSource::Outcome::Read; before_s = report.hostTime_s)
      EXPECT_GE(report.hostTime_s, before_s) << time_s;
  }
}

} // namespace
} // namespace palp
