#include "app/study/live/recordings/RecordingTable.h"

#include "io/board/RecordingWriter.h"
#include "model/base/Cancelled.h"
#include "tests/app/study/live/LiveFixture.h"
#include "tests/io/Refusal.h"
#include "tests/io/TemporaryFolder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace palp {
namespace {

std::vector<std::string> cellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

/// A recording of so many frames of the simulated board, with a mark after the first.
std::filesystem::path recorded(const TemporaryFolder& folder, std::uint64_t frames) {
  const std::filesystem::path path = folder / "a.palprec";
  BoardDisturbance disturbance;
  disturbance.noise = 1e-4;
  VirtualBoard board = simulatedBoard(shippedSamples(), disturbance, 1000, 5);
  RecordingHead head{board.info(), board.configuration(), "a board", "", 1'700'000'000};
  RecordingWriter writer(path, head, false);
  std::uint64_t clock_us = 0, reports = 0;
  while (reports < 20 * frames) {
    clock_us += 1000;
    board.advance(clock_us, [&](std::span<const std::uint8_t> report) {
      const double time_s = 1e-6 * static_cast<double>(clock_us);
      writer.append(RecordingEntry::Kind::Raw, time_s, report);
      const std::string mark = "a \"poke\"";
      if (++reports == 20)
        writer.append(RecordingEntry::Kind::Mark, time_s,
                      {reinterpret_cast<const std::uint8_t*>(mark.data()), mark.size()});
    });
  }
  return path;
}

TEST(RecordingTable, HoldsEveryFrameUnderTheCommandsNames) {
  const TemporaryFolder folder;
  RecordingTableRequest request;
  request.recording = recorded(folder, 30);
  request.table = folder / "a.csv";
  request.decoder = liveDecoder(1e-4);
  request.design = paperDesign();
  request.head = "# made by a test\n";
  double last = 0;
  const auto progress = [&](double share) { last = share; };
  const RecordingTableReport report = writeRecordingTable(request, progress, {});
  EXPECT_EQ(report.frames, 30U);
  std::ifstream file(request.table);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "# made by a test");
  std::getline(file, line);
  const std::string names = "device_s,host_unix_s,frame,valid,area,fx_N,fy_N,fz_N,sd_fx_N,sd_fy_N,sd_fz_N,"
                            "recording_s,complete,lost_reports,missing_readings,temperature_degC,misfit,mark,reason,"
                            "R_r0_c0_ohm,R_r0_c1_ohm,";
  EXPECT_EQ(line.substr(0, names.size()), names);
  const std::vector<std::string> head = cellsOf(line);
  EXPECT_EQ(head.size(), 19U + 300U);
  int frames = 0, marks = 0;
  while (std::getline(file, line)) {
    const std::vector<std::string> cells = cellsOf(line);
    ASSERT_EQ(cells.size(), head.size()) << line;
    EXPECT_EQ(cells[3], "1") << "valid";
    EXPECT_NEAR(std::stod(cells[1]) - 1.7e9, std::stod(cells[11]), 1e-3) << "clock when it was recorded";
    EXPECT_GT(std::stod(cells[8]), 0) << "deviation";
    EXPECT_GT(std::stod(cells[19]), 10) << "ohm";
    marks += cells[17] == "\"a \"\"poke\"\"\"";
    ++frames;
  }
  EXPECT_EQ(frames, 30);
  EXPECT_EQ(marks, 1) << "where it begins";
  EXPECT_LE(last, 1);
}

TEST(RecordingTable, OfNoNetworkItHoldsResistancesAndSaysWhy) {
  const TemporaryFolder folder;
  RecordingTableRequest request;
  request.recording = recorded(folder, 3);
  request.table = folder / "a.csv";
  const RecordingTableReport report = writeRecordingTable(request, [](double) {}, {});
  EXPECT_EQ(report.frames, 3U);
  EXPECT_NE(report.note.find("no network"), std::string::npos) << report.note;
}

TEST(RecordingTable, LeavesNothingWhereItIsStoppedOrCannotBeRead) {
  const TemporaryFolder folder;
  RecordingTableRequest request;
  request.recording = recorded(folder, 3);
  request.table = folder / "a.csv";
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(writeRecordingTable(
                   request, [](double) {}, stop.get_token()),
               Cancelled);
  EXPECT_FALSE(std::filesystem::exists(request.table));
  request.recording = folder / "none.palprec";
  EXPECT_THROW(writeRecordingTable(request, [](double) {}, {}), std::exception);
  EXPECT_FALSE(std::filesystem::exists(request.table));
}

} // namespace
} // namespace palp
