#include "io/board/Protocol.h"

#include "io/AtomicFile.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

namespace palp {
namespace {

std::vector<std::uint8_t> bytesOfHex(std::string text) {
  text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return std::isspace(c) != 0; }), text.end());
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i + 1 < text.size(); i += 2)
    bytes.push_back(static_cast<std::uint8_t>(std::stoi(text.substr(i, 2), nullptr, 16)));
  return bytes;
}

/// A file of resources/board with bytes in hexadecimal.
std::vector<std::uint8_t> golden(const std::string& name) {
  return bytesOfHex(readFile(std::filesystem::path(PALP_SOURCE_DIR) / "resources" / "board" / name));
}

template <class Bytes> std::vector<std::uint8_t> listOf(const Bytes& bytes) {
  return {bytes.begin(), bytes.end()};
}

Readings goldenReadings() {
  Readings readings;
  readings.sequence = 0xFFFF;
  readings.deviceClock_us = 0x01020304;
  readings.frame = 7;
  readings.rowWire = 4;
  readings.firstColumn = 15;
  readings.flags = 0x40;
  readings.temperature_degC = 23.15;
  return readings;
}

TEST(Protocol, ChecksumHasItsCheckValue) {
  const std::string check = "123456789";
  EXPECT_EQ(crc16({reinterpret_cast<const std::uint8_t*>(check.data()), check.size()}), 0x29B1);
}

TEST(Protocol, DescriptorIsThePublishedOne) {
  EXPECT_EQ(listOf(reportDescriptor()), golden("descriptor.hex"));
  EXPECT_EQ(reportDescriptor().size(), 48U);
}

TEST(Protocol, ReadsTheGoldenReport) {
  const std::vector<std::uint8_t> report = golden("readings.hex");
  const auto decoded = decodeInput(report, BoardInfo{});
  const auto* readings = std::get_if<Readings>(&decoded);
  ASSERT_TRUE(readings);
  EXPECT_EQ(readings->sequence, 0xFFFF);
  EXPECT_EQ(readings->deviceClock_us, 0x01020304U);
  EXPECT_EQ(readings->frame, 7);
  EXPECT_EQ(readings->rowWire, 4);
  EXPECT_EQ(readings->firstColumn, 15);
  EXPECT_EQ(readings->count, 15);
  EXPECT_EQ(listOf(encode(*readings)), report);
}

TEST(Protocol, GoldenFeaturesAndMessagesReadAndWriteTheSameBytes) {
  const auto info = golden("info.hex");
  EXPECT_EQ(listOf(encode(std::get<BoardInfo>(decodeInfo(info)))), info);
  const auto configuration = golden("configuration.hex");
  EXPECT_EQ(listOf(encode(std::get<BoardConfiguration>(decodeConfiguration(configuration)))), configuration);
  const auto command = golden("command.hex");
  EXPECT_EQ(listOf(encode(std::get<BoardCommand>(decodeCommand(command)))), command);
  const auto event = golden("event.hex");
  EXPECT_EQ(listOf(encode(std::get<BoardEvent>(decodeInput(event, BoardInfo{})))), event);
}

TEST(Protocol, ABoardSaysItsReadOutOrNothingOfIt) {
  const BoardInfo older = std::get<BoardInfo>(decodeInfo(golden("info.hex")));
  EXPECT_FALSE(older.readout);
  for (const auto& [readout, name] : kReadouts.all()) {
    BoardInfo info = older;
    info.readout = readout;
    const Report report = encode(info);
    EXPECT_EQ(report[31], (older.capabilities | (1 + static_cast<int>(readout)) << 5)) << name;
    EXPECT_EQ(std::get<BoardInfo>(decodeInfo(report)), info) << name;
  }
  Report newer = encode(older);
  newer[31] |= 7 << 5; // a read-out of later days
  seal(newer);
  EXPECT_EQ(std::get<BoardInfo>(decodeInfo(newer)), older);
}

TEST(Protocol, TemperatureMayBeBelowZeroOrMissing) {
  Readings readings = goldenReadings();
  for (const std::optional<double>& temperature : {std::optional<double>(-40), std::optional<double>(), {0.01}}) {
    readings.temperature_degC = temperature;
    const auto decoded = std::get<Readings>(decodeInput(encode(readings), BoardInfo{}));
    ASSERT_EQ(decoded.temperature_degC.has_value(), temperature.has_value());
    EXPECT_NEAR(decoded.temperature_degC.value_or(99), temperature.value_or(99), 1e-9); // a whole number of 0.01
  }
}

ReportFault faultOf(std::span<const std::uint8_t> report) {
  return std::get<ReportFault>(decodeInput(report, BoardInfo{}));
}

TEST(Protocol, EveryOtherLengthIsRefused) {
  const Report good = encode(goldenReadings());
  std::vector<std::uint8_t> bytes(good.begin(), good.end());
  for (const std::size_t length : {0, 1, 12, 63, 65, 100, 256}) {
    bytes.resize(length);
    EXPECT_EQ(faultOf(bytes), ReportFault::Length) << length;
  }
}

TEST(Protocol, EveryFlippedBitIsFoundByTheChecksum) {
  for (std::size_t bit = 8; bit < 8 * kReportBytes; ++bit) { // the first byte is the ID, refused by itself
    Report report = encode(goldenReadings());
    report[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_EQ(faultOf(report), ReportFault::Checksum) << bit;
  }
}

TEST(Protocol, UnknownIdsAreRefused) {
  for (const int id : {0x00, 0x03, 0x10, 0x11, 0x20, 0xFF}) {
    Report report = encode(goldenReadings());
    report[0] = static_cast<std::uint8_t>(id);
    seal(report);
    EXPECT_EQ(faultOf(report), ReportFault::UnknownId) << id;
  }
}

TEST(Protocol, AnotherMajorVersionOrSampleFormatIsRefusedAsSuch) {
  for (const int byte : {0x20, 0x00, 0x11}) {
    Report report = encode(goldenReadings());
    report[1] = static_cast<std::uint8_t>(byte);
    seal(report);
    EXPECT_EQ(faultOf(report), ReportFault::Protocol) << byte;
  }
  BoardInfo info;
  info.protocol = 0x0200;
  EXPECT_EQ(std::get<ReportFault>(decodeInfo(encode(info))), ReportFault::Protocol);
}

TEST(Protocol, RowsColumnsAndCountsOutsideTheBoardAreRefused) {
  const auto faultWith = [](auto change) {
    Readings readings = goldenReadings();
    change(readings);
    return std::holds_alternative<ReportFault>(decodeInput(encode(readings), BoardInfo{}));
  };
  EXPECT_FALSE(faultWith([](Readings&) {}));
  EXPECT_TRUE(faultWith([](Readings& r) { r.rowWire = 10; }));
  EXPECT_TRUE(faultWith([](Readings& r) { r.rowWire = 255; }));
  EXPECT_TRUE(faultWith([](Readings& r) { r.firstColumn = 14; }));
  EXPECT_TRUE(faultWith([](Readings& r) { r.firstColumn = 30; }));
  EXPECT_TRUE(faultWith([](Readings& r) { r.count = 0; }));
  EXPECT_TRUE(faultWith([](Readings& r) { r.count = 16; }));
  EXPECT_TRUE(faultWith([](Readings& r) { r.rangeIndex = 4; }));
}

TEST(Protocol, AReadingInARangeThatTheBoardDoesNotHaveIsRefused) {
  BoardInfo info;
  info.reference_ohm[3] = 0;
  Readings readings = goldenReadings();
  readings.rangeIndex = 2;
  EXPECT_TRUE(std::holds_alternative<Readings>(decodeInput(encode(readings), info)));
  readings.rangeIndex = 3; // any code of it would be a good reading of 0 ohm
  EXPECT_EQ(std::get<ReportFault>(decodeInput(encode(readings), info)), ReportFault::OutOfRange);
}

TEST(Protocol, BoardsOfImpossibleSizeAreRefused) {
  const auto refused = [](auto change) {
    BoardInfo info;
    change(info);
    return std::holds_alternative<ReportFault>(decodeInfo(encode(info)));
  };
  EXPECT_FALSE(refused([](BoardInfo&) {}));
  EXPECT_TRUE(refused([](BoardInfo& i) { i.rowWires = 0; }));
  EXPECT_TRUE(refused([](BoardInfo& i) { i.rowWires = 33; }));
  EXPECT_TRUE(refused([](BoardInfo& i) { i.columnWires = 0; }));
  EXPECT_TRUE(refused([](BoardInfo& i) { i.reference_ohm[0] = 0; }));
}

TEST(Protocol, TextOfABoardIsShownWithoutItsControlCharacters) {
  BoardEvent event;
  event.text = "too\x1b[31m warm\n";
  EXPECT_EQ(std::get<BoardEvent>(decodeInput(encode(event), BoardInfo{})).text, "too?[31m warm?");
}

TEST(Protocol, RandomBytesAreAlwaysRefusedOrInRange) {
  std::mt19937 engine(1);
  for (int i = 0; i < 20000; ++i) {
    Report report;
    for (std::uint8_t& byte : report) byte = static_cast<std::uint8_t>(engine());
    report[0] = static_cast<std::uint8_t>(engine() % 2 + 1);
    report[1] = 0x10;
    seal(report);
    const auto decoded = decodeInput(report, BoardInfo{});
    if (const auto* readings = std::get_if<Readings>(&decoded)) {
      EXPECT_LT(readings->rowWire, 10);
      EXPECT_LE(readings->firstColumn + readings->count, 30);
    }
  }
}

} // namespace
} // namespace palp
