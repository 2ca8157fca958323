#include "io/board/VirtualBoard.h"

#include "model/base/Error.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr double kClockTick_s = 1e-6;
constexpr std::uint64_t kMicrosecondsPerSecond = 1'000'000;
constexpr std::uint32_t kPatternBase = 0x100000;
constexpr std::uint32_t kPatternRow = 0x1000;
constexpr std::size_t kTruncatedBytes = 40;

bool contains(const std::vector<int>& wires, int wire) {
  return std::find(wires.begin(), wires.end(), wire) != wires.end();
}

bool everyNth(int n, std::uint64_t count) {
  return n > 0 && count % static_cast<std::uint64_t>(n) == static_cast<std::uint64_t>(n) - 1;
}

} // namespace

VirtualBoard::VirtualBoard(BoardSettings settings, Resistances resistances)
    : settings_(std::move(settings)), resistances_(std::move(resistances)), engine_(settings_.seed) {
  const BoardInfo& info = settings_.info;
  if (info.rowWires < 1 || info.rowWires > kMostRowWires || info.columnWires < 1 || info.columnWires > 255)
    throw Error("a board with " + std::to_string(info.rowWires) + " row-wires and " + std::to_string(info.columnWires) +
                " column-wires; the protocol allows up to 32 and 255");
  rest_ohm_ = resistances_(0);
  if (rest_ohm_.rows() != info.rowWires || rest_ohm_.cols() != info.columnWires)
    throw Error("the board has " + std::to_string(info.rowWires) + " x " + std::to_string(info.columnWires) +
                " wires, the sensor " + std::to_string(rest_ohm_.rows()) + " x " + std::to_string(rest_ohm_.cols()));
  restart();
}

void VirtualBoard::restart() {
  start_us_.reset();
  sent_ = 0;
  sequence_ = frame_ = 0;
  row_ = nextRow(-1);
  firstColumn_ = 0;
  streaming_ = true;
  events_.clear();
  play_ = Eigen::MatrixXd::Zero(rest_ohm_.rows(), rest_ohm_.cols());
  now_ohm_ = nullptr;
}

std::optional<Report> VirtualBoard::feature(std::uint8_t id) const {
  if (id == static_cast<std::uint8_t>(ReportId::Info)) return encode(settings_.info);
  if (id == static_cast<std::uint8_t>(ReportId::Configuration)) return encode(settings_.configuration);
  return {};
}

bool VirtualBoard::setFeature(std::span<const std::uint8_t> report) {
  const auto decoded = decodeConfiguration(report);
  const auto* wanted = std::get_if<BoardConfiguration>(&decoded);
  if (!wanted || wanted->rate_Hz < 1 || wanted->rate_Hz > settings_.info.highestRate_Hz) return false;
  const bool rangeKnown = wanted->range == BoardConfiguration::kAutomaticRange ||
                          (wanted->range < static_cast<int>(settings_.info.reference_ohm.size()) &&
                           settings_.info.reference_ohm[static_cast<std::size_t>(wanted->range)] > 0);
  const std::uint32_t rows =
      wanted->rowMask & (settings_.info.rowWires == kMostRowWires ? ~std::uint32_t{0}
                                                                  : (std::uint32_t{1} << settings_.info.rowWires) - 1);
  if (!rangeKnown || rows == 0) return false;
  const int generation = (settings_.configuration.generation + 1) & 0xFF;
  settings_.configuration = *wanted;
  settings_.configuration.rowMask = rows;
  settings_.configuration.generation = generation;
  row_ = nextRow(-1); // a scan of the old configuration is never ended
  firstColumn_ = 0;
  ++frame_;
  now_ohm_ = nullptr;
  if (start_us_) {
    streamStart_us_ = *start_us_ + static_cast<std::uint64_t>(time_s_ * kMicrosecondsPerSecond);
    sent_ = 0;
  }
  return true;
}

bool VirtualBoard::output(std::span<const std::uint8_t> report) {
  const auto decoded = decodeCommand(report);
  const auto* command = std::get_if<BoardCommand>(&decoded);
  if (!command) return false;
  answer(*command);
  return true;
}

void VirtualBoard::answer(const BoardCommand& command) {
  BoardEvent event;
  event.tag = command.tag;
  event.opcode = static_cast<std::uint8_t>(command.opcode);
  switch (command.opcode) {
  case Opcode::Start: {
    const auto rate_Hz = static_cast<int>(std::min<std::uint32_t>(command.arguments[0], 1'000'000));
    if (rate_Hz > settings_.info.highestRate_Hz) {
      event.code = EventCode::Refused;
      event.text = "rate above " + std::to_string(settings_.info.highestRate_Hz) + " per s";
      break;
    }
    if (rate_Hz > 0) settings_.configuration.rate_Hz = rate_Hz;
    streaming_ = true;
    sent_ = 0;
    if (start_us_) streamStart_us_ = *start_us_ + static_cast<std::uint64_t>(time_s_ * kMicrosecondsPerSecond);
    break;
  }
  case Opcode::Stop:
    streaming_ = false;
    break;
  case Opcode::Tare:
  case Opcode::ClearTare:
  case Opcode::Identify:
    event.code = EventCode::Refused;
    event.text = "not among the capabilities";
    break;
  }
  events_.push_back(event);
}

std::optional<std::uint64_t> VirtualBoard::nextDue_us() const {
  if (!events_.empty() || !start_us_) return 0;
  if (!streaming_ || settings_.configuration.mode == BoardMode::Idle) return {};
  return streamStart_us_ + sent_ * kMicrosecondsPerSecond / static_cast<std::uint64_t>(settings_.configuration.rate_Hz);
}

void VirtualBoard::advance(std::uint64_t clock_us, const Send& send) {
  if (!start_us_) start_us_ = streamStart_us_ = clock_us;
  while (const std::optional<std::uint64_t> due_us = nextDue_us()) {
    if (*due_us > clock_us) break;
    if (!events_.empty()) {
      BoardEvent event = events_.front();
      events_.pop_front();
      event.deviceClock_us = static_cast<std::uint32_t>(clock_us - *start_us_);
      send(encode(event));
      continue;
    }
    ++sent_;
    sendWithFaults(encode(nextReadings(*due_us)), send);
  }
  time_s_ = static_cast<double>(clock_us - *start_us_) * kClockTick_s;
}

Readings VirtualBoard::nextReadings(std::uint64_t clock_us) {
  const BoardInfo& info = settings_.info;
  const BoardConfiguration& configuration = settings_.configuration;
  time_s_ = static_cast<double>(clock_us - *start_us_) * kClockTick_s;
  followWarming();
  Readings readings;
  const bool first = row_ == nextRow(-1) && firstColumn_ == 0;
  if (first || !now_ohm_) now_ohm_ = &resistances_(time_s_);
  readings.sequence = sequence_++;
  readings.deviceClock_us = static_cast<std::uint32_t>(clock_us - *start_us_);
  readings.frame = frame_;
  readings.rowWire = row_;
  readings.firstColumn = firstColumn_;
  readings.count = std::min(kReadingsPerReport, info.columnWires - firstColumn_);
  readings.temperature_degC = temperature_degC();
  readings.generation = configuration.generation & 0xF;
  readings.rangeIndex = rangeOf(row_);
  const double reference_ohm = info.reference_ohm[static_cast<std::size_t>(readings.rangeIndex)];
  for (int i = 0; i < readings.count; ++i)
    readings.codes[static_cast<std::size_t>(i)] = code(row_, firstColumn_ + i, reference_ohm);
  firstColumn_ += kReadingsPerReport;
  bool last = false;
  if (firstColumn_ >= info.columnWires) {
    firstColumn_ = 0;
    const int next = configuration.mode == BoardMode::SingleRow ? row_ : nextRow(row_);
    last = next <= row_;
    row_ = next;
    if (last) ++frame_;
  }
  readings.flags = static_cast<std::uint8_t>(ReadingFlag::Simulated | (first ? ReadingFlag::FirstOfFrame : 0) |
                                             (last ? ReadingFlag::LastOfFrame : 0) |
                                             (settings_.faults.excitationFault ? ReadingFlag::ExcitationFault : 0));
  return readings;
}

std::uint32_t VirtualBoard::code(int row, int column, double reference_ohm) {
  const BoardFaults& faults = settings_.faults;
  if (settings_.configuration.mode == BoardMode::TestPattern)
    return kPatternBase + kPatternRow * static_cast<std::uint32_t>(row) + static_cast<std::uint32_t>(column);
  if (contains(faults.openRows, row) || contains(faults.openColumns, column))
    return encodeResistance(std::numeric_limits<double>::infinity(), reference_ohm);
  if (std::find(faults.shortReadings.begin(), faults.shortReadings.end(), std::pair{row, column}) !=
      faults.shortReadings.end())
    return encodeResistance(0, reference_ohm);
  return encodeResistance(disturbed(row, column, (*now_ohm_)(row, column)), reference_ohm);
}

/// Play operator (rate-independent hysteresis), drift by temperature, noise.
double VirtualBoard::disturbed(int row, int column, double resistance_ohm) {
  const BoardDisturbance& d = settings_.disturbance;
  const double change = resistance_ohm / rest_ohm_(row, column) - 1;
  double& play = play_(row, column);
  play = std::clamp(play, change - d.hysteresisWidth, change + d.hysteresisWidth);
  const double felt = (1 - d.hysteresisShare) * change + d.hysteresisShare * play;
  const double warmer_degC = temperature_degC() - d.startTemperature_degC;
  return rest_ohm_(row, column) * (1 + felt) * (1 + d.temperatureCoefficient * warmer_degC) *
         (1 + d.noise * normal_(engine_));
}

void VirtualBoard::followWarming() {
  const BoardDisturbance& d = settings_.disturbance;
  if (!warming_) {
    warming_ = Warming{d.warming_degC, firstWarmth_degC_, 0};
  } else if (d.warming_degC != warming_->to_degC) {
    const double now_degC = temperature_degC() - d.startTemperature_degC;
    warming_ = Warming{d.warming_degC, now_degC, time_s_};
  }
}

double VirtualBoard::temperature_degC() const {
  const BoardDisturbance& d = settings_.disturbance;
  const Warming warming = warming_.value_or(Warming{d.warming_degC, firstWarmth_degC_, 0});
  const double rise_degC = warming.to_degC - warming.from_degC;
  return d.startTemperature_degC + warming.from_degC +
         rise_degC * (1 - std::exp(-(time_s_ - warming.begin_s) / d.warmingTime_s));
}

/// The configured range, or the one whose reference is nearest the row's resistances (the divider is finest there).
int VirtualBoard::rangeOf(int row) const {
  if (settings_.configuration.range != BoardConfiguration::kAutomaticRange) return settings_.configuration.range;
  const double typical_ohm = rest_ohm_.row(row).mean();
  int best = 0;
  const auto distance = [&](double reference_ohm) {
    return reference_ohm > 0 ? std::abs(std::log(reference_ohm / typical_ohm)) : 1e300;
  };
  const auto& references_ohm = settings_.info.reference_ohm;
  for (int i = 1; i < static_cast<int>(references_ohm.size()); ++i)
    if (distance(references_ohm[static_cast<std::size_t>(i)]) <
        distance(references_ohm[static_cast<std::size_t>(best)]))
      best = i;
  return best;
}

/// The next row-wire of the mask after this one, from the lowest again behind the highest.
int VirtualBoard::nextRow(int after) const {
  const std::uint32_t mask = settings_.configuration.rowMask;
  for (int row = after + 1; row < settings_.info.rowWires; ++row)
    if ((mask >> row & 1) != 0) return row;
  return std::countr_zero(mask);
}

void VirtualBoard::sendWithFaults(Report report, const Send& send) {
  const BoardFaults& faults = settings_.faults;
  const std::uint64_t count = sent_ - 1;
  if (everyNth(faults.dropEvery, count)) return;
  if (everyNth(faults.wrongMajorEvery, count)) {
    report[1] = 0x20;
    seal(report);
  }
  if (everyNth(faults.corruptEvery, count)) report[20 + count % 30] ^= static_cast<std::uint8_t>(1U << count % 8);
  const std::size_t bytes = everyNth(faults.truncateEvery, count) ? kTruncatedBytes : kReportBytes;
  send(std::span(report).first(bytes));
  if (everyNth(faults.duplicateEvery, count)) send(report);
}

} // namespace palp
