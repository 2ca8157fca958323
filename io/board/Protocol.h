#pragma once

#include "model/ResistanceLaw.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace palp {

// Wire protocol of the sensor board, version 1: resources/board/protocol.md. Little-endian reports of 64 bytes, each
// with its ID first and a checksum last.

inline constexpr std::size_t kReportBytes = 64;
inline constexpr int kReadingsPerReport = 15;
inline constexpr int kMostRowWires = 32; ///< bits of the row mask
using Report = std::array<std::uint8_t, kReportBytes>;

enum class ReportId : std::uint8_t { Readings = 0x01, Event = 0x02, Info = 0x10, Configuration = 0x11, Command = 0x20 };

/// USB vendor and product; the defaults are the private test ID of pid.codes.
struct UsbId {
  std::uint16_t vendor = 0x1209;
  std::uint16_t product = 0x0001;
};

/// Bits of Readings::flags.
struct ReadingFlag {
  static constexpr std::uint8_t FirstOfFrame = 1 << 0;
  static constexpr std::uint8_t LastOfFrame = 1 << 1;
  static constexpr std::uint8_t Tared = 1 << 2;
  static constexpr std::uint8_t ExcitationFault = 1 << 3;
  static constexpr std::uint8_t AdcOverrun = 1 << 4;
  static constexpr std::uint8_t DeviceDropped = 1 << 5;
  static constexpr std::uint8_t Simulated = 1 << 6;
};

/// Input report 0x01: up to 15 neighbouring column-wires of one row-wire.
struct Readings {
  std::uint16_t sequence = 0;       ///< +1 a report, wraps
  std::uint32_t deviceClock_us = 0; ///< at the first reading; wraps after 71.6 min
  std::uint16_t frame = 0;
  int rowWire = 0;
  int firstColumn = 0; ///< a multiple of 15
  int count = kReadingsPerReport;
  std::uint8_t flags = 0;
  std::optional<double> temperature_degC;
  std::array<std::uint32_t, kReadingsPerReport> codes{}; ///< 24 bits each
  int rangeIndex = 0;                                    ///< picks BoardInfo::reference_ohm
  int generation = 0;                                    ///< low four bits of the configuration's
};

/// Feature 0x10: what the board is.
struct BoardInfo {
  static constexpr std::uint8_t HasTemperature = 1, HasAutomaticRange = 2, HasTare = 4, HasIdentify = 8,
                                HasPattern = 16;

  std::uint16_t protocol = 0x0100;
  std::uint16_t firmware = 0;
  int rowWires = 10;
  int columnWires = 30;
  int electrodesPerRowWire = 10;
  int electrodesPerColumnWire = 3;
  int highestRate_Hz = 8000; ///< reports per second
  std::array<double, 4> reference_ohm{300, 1000, 10000, 100000};
  int excitation_mV = 2500;
  int effectiveBits = 18;
  std::uint8_t capabilities = HasTemperature | HasAutomaticRange | HasPattern;
  std::string serial; ///< up to 16 characters
  double pitchX_mm = 3;
  double pitchY_mm = 1;
  double thickness_mm = 5;
  std::string model;              ///< up to 8 characters
  std::optional<Readout> readout; ///< what the other wires are at while two are read; none: the board does not say
  bool operator==(const BoardInfo&) const = default;
};

enum class BoardMode : std::uint8_t { Idle = 0, Stream = 1, TestPattern = 2, SingleRow = 3 };

/// Feature 0x11: what the board does.
struct BoardConfiguration {
  static constexpr int kAutomaticRange = 0xFF;

  BoardMode mode = BoardMode::Stream;
  int generation = 0; ///< the board counts it up at each change
  std::uint32_t rowMask = 0x3FF;
  int rate_Hz = 1000; ///< reports per second
  int log2Oversampling = 0;
  int range = kAutomaticRange;
  bool operator==(const BoardConfiguration&) const = default;
};

enum class Opcode : std::uint8_t { Start = 1, Stop = 2, Tare = 3, ClearTare = 4, Identify = 5 };

/// Output 0x20.
struct BoardCommand {
  Opcode opcode = Opcode::Start;
  std::uint16_t tag = 0;
  std::array<std::uint32_t, 2> arguments{};
};

enum class EventCode : std::uint8_t {
  Done = 0,
  Refused = 1,
  Busy = 2,
  ExcitationFault = 3,
  AdcFault = 4,
  TooWarm = 5,
  ConfigurationChanged = 6
};

/// Input report 0x02: the answer to a command, or a message that the board sends on its own (tag 0).
struct BoardEvent {
  std::uint16_t tag = 0;
  std::uint32_t deviceClock_us = 0;
  EventCode code = EventCode::Done;
  std::uint8_t opcode = 0; ///< that is answered
  std::uint16_t detail = 0;
  std::string text; ///< up to 50 characters
};

/// Why a report was dropped.
enum class ReportFault { Length, UnknownId, Protocol, Checksum, OutOfRange };
const char* sentence(ReportFault fault);

/// CRC-16/CCITT-FALSE: polynomial 0x1021, start 0xFFFF; of "123456789" 0x29B1.
std::uint16_t crc16(std::span<const std::uint8_t> bytes);
/// Writes the checksum of bytes 0..61 to bytes 62, 63.
void seal(Report& report);

/// The 48 bytes of the board's HID report descriptor (usage page FF00, usage 5453).
std::span<const std::uint8_t> reportDescriptor();

Report encode(const Readings& readings);
Report encode(const BoardInfo& info);
Report encode(const BoardConfiguration& configuration);
Report encode(const BoardCommand& command);
Report encode(const BoardEvent& event);

/// What came in; rows and columns are checked against the board's own.
std::variant<Readings, BoardEvent, ReportFault> decodeInput(std::span<const std::uint8_t> report,
                                                            const BoardInfo& info);
std::variant<BoardInfo, ReportFault> decodeInfo(std::span<const std::uint8_t> report);
std::variant<BoardConfiguration, ReportFault> decodeConfiguration(std::span<const std::uint8_t> report);
std::variant<BoardCommand, ReportFault> decodeCommand(std::span<const std::uint8_t> report);

} // namespace palp
