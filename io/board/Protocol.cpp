#include "io/board/Protocol.h"

#include "io/board/ByteOrder.h"

#include <cmath>

namespace palp {

namespace {

constexpr std::size_t kChecksumAt = 62;
constexpr std::uint8_t kVersion = 1;           // of feature, command and event layouts
constexpr std::uint8_t kMajorAndFormat = 0x10; // protocol 1, u24 divider codes
constexpr std::uint32_t kNoTemperature = 0x8000;
constexpr double kDegreeStep_degC = 0.01;
constexpr int kReadoutBit = 5; // of the capabilities: three bits, 0 of boards that do not say it, else 1 + Readout
constexpr std::uint8_t kCapabilityBits = (1 << kReadoutBit) - 1;

constexpr std::array<std::uint8_t, 48> kDescriptor{0x06, 0x00, 0xFF,                               // usage page FF00
                                                   0x0A, 0x53, 0x54,                               // usage 5453
                                                   0xA1, 0x01,                                     // application
                                                   0x15, 0x00, 0x26, 0xFF, 0x00, 0x75, 0x08, 0x95, // bytes 0..255,
                                                   0x3F,                               // 63 of them, after the ID:
                                                   0x85, 0x01, 0x09, 0x01, 0x81, 0x02, // input 0x01
                                                   0x85, 0x02, 0x09, 0x02, 0x81, 0x02, // input 0x02
                                                   0x85, 0x20, 0x09, 0x20, 0x91, 0x02, // output 0x20
                                                   0x85, 0x10, 0x09, 0x10, 0xB1, 0x02, // feature 0x10
                                                   0x85, 0x11, 0x09, 0x11, 0xB1, 0x02, // feature 0x11
                                                   0xC0};

/// The checksum's remainder of each byte alone.
constexpr std::array<std::uint16_t, 256> checksumOfByte() {
  std::array<std::uint16_t, 256> table{};
  for (std::size_t byte = 0; byte < table.size(); ++byte) {
    auto crc = static_cast<std::uint16_t>(byte << 8);
    for (int bit = 0; bit < 8; ++bit)
      crc = static_cast<std::uint16_t>((crc & 0x8000) != 0 ? (crc << 1) ^ 0x1021 : crc << 1);
    table[byte] = crc;
  }
  return table;
}
constexpr std::array<std::uint16_t, 256> kChecksumOfByte = checksumOfByte();

Report empty(ReportId id) {
  Report report{};
  report[0] = static_cast<std::uint8_t>(id);
  return report;
}

/// Length, ID and checksum.
std::optional<ReportFault> faultOf(std::span<const std::uint8_t> report, ReportId id) {
  if (report.size() != kReportBytes) return ReportFault::Length;
  if (report[0] != static_cast<std::uint8_t>(id)) return ReportFault::UnknownId;
  if (littleEndian<2>(report, kChecksumAt) != crc16(report.first(kChecksumAt))) return ReportFault::Checksum;
  return {};
}

std::uint32_t temperatureField(const std::optional<double>& temperature_degC) {
  if (!temperature_degC) return kNoTemperature;
  return static_cast<std::uint32_t>(std::lround(*temperature_degC / kDegreeStep_degC)) & 0xFFFF;
}

std::uint8_t capabilitiesField(const BoardInfo& info) {
  const int readout = info.readout ? 1 + static_cast<int>(*info.readout) : 0;
  return static_cast<std::uint8_t>((info.capabilities & kCapabilityBits) | readout << kReadoutBit);
}

/// None also for one that this Palp does not know.
std::optional<Readout> readoutOf(std::uint8_t field) {
  const int readout = (field >> kReadoutBit) - 1;
  if (readout < 0 || readout >= static_cast<int>(kReadouts.all().size())) return {};
  return static_cast<Readout>(readout);
}

std::variant<Readings, BoardEvent, ReportFault> decodeReadings(std::span<const std::uint8_t> report,
                                                               const BoardInfo& info) {
  if (report[1] != kMajorAndFormat) return ReportFault::Protocol;
  Readings readings;
  readings.sequence = static_cast<std::uint16_t>(littleEndian<2>(report, 2));
  readings.deviceClock_us = littleEndian<4>(report, 4);
  readings.frame = static_cast<std::uint16_t>(littleEndian<2>(report, 8));
  readings.rowWire = report[10];
  readings.firstColumn = report[11];
  readings.count = report[12];
  readings.flags = report[13];
  const auto temperature = static_cast<std::int16_t>(littleEndian<2>(report, 14));
  if (littleEndian<2>(report, 14) != kNoTemperature) readings.temperature_degC = temperature * kDegreeStep_degC;
  for (std::size_t i = 0; i < readings.codes.size(); ++i) readings.codes[i] = littleEndian<3>(report, 16 + 3 * i);
  readings.rangeIndex = report[61] >> 4;
  readings.generation = report[61] & 0xF;
  const bool inRange = readings.rowWire < info.rowWires && readings.firstColumn % kReadingsPerReport == 0 &&
                       readings.count >= 1 && readings.count <= kReadingsPerReport &&
                       readings.firstColumn + readings.count <= info.columnWires &&
                       readings.rangeIndex < static_cast<int>(info.reference_ohm.size()) &&
                       info.reference_ohm[static_cast<std::size_t>(readings.rangeIndex)] > 0; // 0: no such range
  if (!inRange) return ReportFault::OutOfRange;
  return readings;
}

std::variant<Readings, BoardEvent, ReportFault> decodeEvent(std::span<const std::uint8_t> report) {
  if (report[1] != kVersion) return ReportFault::Protocol;
  if (report[8] > static_cast<std::uint8_t>(EventCode::ConfigurationChanged)) return ReportFault::OutOfRange;
  BoardEvent event;
  event.tag = static_cast<std::uint16_t>(littleEndian<2>(report, 2));
  event.deviceClock_us = littleEndian<4>(report, 4);
  event.code = static_cast<EventCode>(report[8]);
  event.opcode = report[9];
  event.detail = static_cast<std::uint16_t>(littleEndian<2>(report, 10));
  event.text = textField(report.subspan(12, 50));
  return event;
}

} // namespace

const char* sentence(ReportFault fault) {
  switch (fault) {
  case ReportFault::Length:
    return "the report is not 64 bytes long";
  case ReportFault::UnknownId:
    return "the report's ID is not one of the protocol's";
  case ReportFault::Protocol:
    return "the report is of another protocol than version 1";
  case ReportFault::Checksum:
    return "the report's checksum is wrong";
  case ReportFault::OutOfRange:
    return "a row-wire, column-wire, count or code is out of range";
  }
  return "";
}

std::uint16_t crc16(std::span<const std::uint8_t> bytes) {
  std::uint16_t crc = 0xFFFF;
  for (const std::uint8_t byte : bytes)
    crc = static_cast<std::uint16_t>((crc << 8) ^ kChecksumOfByte[(crc >> 8) ^ byte]);
  return crc;
}

void seal(Report& report) {
  putLittleEndian<2>(report, kChecksumAt, crc16(std::span(report).first(kChecksumAt)));
}

std::span<const std::uint8_t> reportDescriptor() {
  return kDescriptor;
}

Report encode(const Readings& readings) {
  Report report = empty(ReportId::Readings);
  report[1] = kMajorAndFormat;
  putLittleEndian<2>(report, 2, readings.sequence);
  putLittleEndian<4>(report, 4, readings.deviceClock_us);
  putLittleEndian<2>(report, 8, readings.frame);
  report[10] = static_cast<std::uint8_t>(readings.rowWire);
  report[11] = static_cast<std::uint8_t>(readings.firstColumn);
  report[12] = static_cast<std::uint8_t>(readings.count);
  report[13] = readings.flags;
  putLittleEndian<2>(report, 14, temperatureField(readings.temperature_degC));
  for (std::size_t i = 0; i < readings.codes.size(); ++i) putLittleEndian<3>(report, 16 + 3 * i, readings.codes[i]);
  report[61] = static_cast<std::uint8_t>((readings.rangeIndex << 4) | (readings.generation & 0xF));
  seal(report);
  return report;
}

Report encode(const BoardInfo& info) {
  const auto micrometres = [](double mm) { return static_cast<std::uint32_t>(std::lround(1000 * mm)); };
  Report report = empty(ReportId::Info);
  report[1] = kVersion;
  putLittleEndian<2>(report, 2, info.protocol);
  putLittleEndian<2>(report, 4, info.firmware);
  report[6] = static_cast<std::uint8_t>(info.rowWires);
  report[7] = static_cast<std::uint8_t>(info.columnWires);
  report[8] = static_cast<std::uint8_t>(info.electrodesPerRowWire);
  report[9] = static_cast<std::uint8_t>(info.electrodesPerColumnWire);
  putLittleEndian<2>(report, 10, static_cast<std::uint32_t>(info.highestRate_Hz));
  for (std::size_t i = 0; i < info.reference_ohm.size(); ++i)
    putLittleEndian<4>(report, 12 + 4 * i, static_cast<std::uint32_t>(std::llround(1000 * info.reference_ohm[i])));
  putLittleEndian<2>(report, 28, static_cast<std::uint32_t>(info.excitation_mV));
  report[30] = static_cast<std::uint8_t>(info.effectiveBits);
  report[31] = capabilitiesField(info);
  putTextField(std::span(report).subspan(32, 16), info.serial);
  putLittleEndian<2>(report, 48, micrometres(info.pitchX_mm));
  putLittleEndian<2>(report, 50, micrometres(info.pitchY_mm));
  putLittleEndian<2>(report, 52, micrometres(info.thickness_mm));
  putTextField(std::span(report).subspan(54, 8), info.model);
  seal(report);
  return report;
}

Report encode(const BoardConfiguration& configuration) {
  Report report = empty(ReportId::Configuration);
  report[1] = kVersion;
  report[2] = static_cast<std::uint8_t>(configuration.mode);
  report[3] = static_cast<std::uint8_t>(configuration.generation);
  putLittleEndian<4>(report, 4, configuration.rowMask);
  putLittleEndian<2>(report, 12, static_cast<std::uint32_t>(configuration.rate_Hz));
  report[14] = static_cast<std::uint8_t>(configuration.log2Oversampling);
  report[15] = static_cast<std::uint8_t>(configuration.range);
  seal(report);
  return report;
}

Report encode(const BoardCommand& command) {
  Report report = empty(ReportId::Command);
  report[1] = static_cast<std::uint8_t>(command.opcode);
  putLittleEndian<2>(report, 2, command.tag);
  putLittleEndian<4>(report, 4, command.arguments[0]);
  putLittleEndian<4>(report, 8, command.arguments[1]);
  seal(report);
  return report;
}

Report encode(const BoardEvent& event) {
  Report report = empty(ReportId::Event);
  report[1] = kVersion;
  putLittleEndian<2>(report, 2, event.tag);
  putLittleEndian<4>(report, 4, event.deviceClock_us);
  report[8] = static_cast<std::uint8_t>(event.code);
  report[9] = event.opcode;
  putLittleEndian<2>(report, 10, event.detail);
  putTextField(std::span(report).subspan(12, 50), event.text);
  seal(report);
  return report;
}

std::variant<Readings, BoardEvent, ReportFault> decodeInput(std::span<const std::uint8_t> report,
                                                            const BoardInfo& info) {
  const bool isEvent = report.size() == kReportBytes && report[0] == static_cast<std::uint8_t>(ReportId::Event);
  if (const auto fault = faultOf(report, isEvent ? ReportId::Event : ReportId::Readings)) return *fault;
  return isEvent ? decodeEvent(report) : decodeReadings(report, info);
}

std::variant<BoardInfo, ReportFault> decodeInfo(std::span<const std::uint8_t> report) {
  if (const auto fault = faultOf(report, ReportId::Info)) return *fault;
  BoardInfo info;
  info.protocol = static_cast<std::uint16_t>(littleEndian<2>(report, 2));
  if (report[1] != kVersion || info.protocol >> 8 != 1) return ReportFault::Protocol;
  info.firmware = static_cast<std::uint16_t>(littleEndian<2>(report, 4));
  info.rowWires = report[6];
  info.columnWires = report[7];
  info.electrodesPerRowWire = report[8];
  info.electrodesPerColumnWire = report[9];
  info.highestRate_Hz = static_cast<int>(littleEndian<2>(report, 10));
  bool inRange = info.rowWires >= 1 && info.rowWires <= kMostRowWires && info.columnWires >= 1;
  for (std::size_t i = 0; i < info.reference_ohm.size(); ++i)
    info.reference_ohm[i] = littleEndian<4>(report, 12 + 4 * i) / 1000.0;
  inRange = inRange && info.reference_ohm[0] > 0;
  info.excitation_mV = static_cast<int>(littleEndian<2>(report, 28));
  info.effectiveBits = report[30];
  info.capabilities = report[31] & kCapabilityBits;
  info.readout = readoutOf(report[31]);
  info.serial = textField(report.subspan(32, 16));
  info.pitchX_mm = littleEndian<2>(report, 48) / 1000.0;
  info.pitchY_mm = littleEndian<2>(report, 50) / 1000.0;
  info.thickness_mm = littleEndian<2>(report, 52) / 1000.0;
  info.model = textField(report.subspan(54, 8));
  if (!inRange) return ReportFault::OutOfRange;
  return info;
}

std::variant<BoardConfiguration, ReportFault> decodeConfiguration(std::span<const std::uint8_t> report) {
  if (const auto fault = faultOf(report, ReportId::Configuration)) return *fault;
  if (report[1] != kVersion) return ReportFault::Protocol;
  if (report[2] > static_cast<std::uint8_t>(BoardMode::SingleRow)) return ReportFault::OutOfRange;
  BoardConfiguration configuration;
  configuration.mode = static_cast<BoardMode>(report[2]);
  configuration.generation = report[3];
  configuration.rowMask = littleEndian<4>(report, 4);
  configuration.rate_Hz = static_cast<int>(littleEndian<2>(report, 12));
  configuration.log2Oversampling = report[14];
  configuration.range = report[15];
  return configuration;
}

std::variant<BoardCommand, ReportFault> decodeCommand(std::span<const std::uint8_t> report) {
  if (const auto fault = faultOf(report, ReportId::Command)) return *fault;
  if (report[1] < 1 || report[1] > static_cast<std::uint8_t>(Opcode::Identify)) return ReportFault::OutOfRange;
  BoardCommand command;
  command.opcode = static_cast<Opcode>(report[1]);
  command.tag = static_cast<std::uint16_t>(littleEndian<2>(report, 2));
  command.arguments = {littleEndian<4>(report, 4), littleEndian<4>(report, 8)};
  return command;
}

} // namespace palp
