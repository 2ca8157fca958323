#pragma once

#include "io/board/BoardFrame.h"

#include <deque>
#include <functional>
#include <random>
#include <vector>

namespace palp {

/// What a real board and its rubber add to the resistances of the model; all off but the noise of a good board.
struct BoardDisturbance {
  double noise = 5e-6; ///< relative to R, rms of one reading
  double startTemperature_degC = 23;
  double warming_degC = 0;              ///< the temperature rises by this much ...
  double warmingTime_s = 300;           ///< ... as 1 - exp(-t / warmingTime)
  double temperatureCoefficient = 1e-3; ///< relative change of R a degree
  double hysteresisShare = 0;           ///< of the change of R since rest, 0..1, that goes through the play below
  double hysteresisWidth = 1e-4;        ///< half width of the play, relative to R at rest
};

/// What can go wrong; all off.
struct BoardFaults {
  std::vector<int> openRows, openColumns;
  std::vector<std::pair<int, int>> shortReadings; ///< row-wire, column-wire
  bool excitationFault = false;
  int dropEvery = 0;      ///< every n-th report is never sent, though it counts
  int corruptEvery = 0;   ///< one bit of every n-th report flips
  int duplicateEvery = 0; ///< every n-th report is sent twice
  int truncateEvery = 0;  ///< every n-th report lacks its last bytes
  int wrongMajorEvery = 0;
};

struct BoardSettings {
  BoardInfo info;
  BoardConfiguration configuration;
  BoardDisturbance disturbance;
  BoardFaults faults;
  std::uint64_t seed = 1;
};

/// The virtual board: answers features and commands and sends reports as a real one does, on a clock that is given to
/// it. The simulated board of the application, of the tests and of the test machine are this class.
class VirtualBoard {
public:
  /// Resistances [ohm] of the sensor, row-wires x column-wires, at a time since the board's start.
  using Resistances = std::function<const Eigen::MatrixXd&(double time_s)>;

  VirtualBoard(BoardSettings settings, Resistances resistances);

  /// Feature 0x10 or 0x11; none for another ID.
  [[nodiscard]] std::optional<Report> feature(std::uint8_t id) const;
  /// Applies feature 0x11; false where the board refuses it.
  bool setFeature(std::span<const std::uint8_t> report);
  /// Takes a command; its answer comes among the next reports. Returns false where it is not a command.
  bool output(std::span<const std::uint8_t> report);

  /// Sends what is due up to this clock, in order; a truncated report is shorter than 64 bytes.
  void advance(std::uint64_t clock_us, const std::function<void(std::span<const std::uint8_t>)>& send);
  /// When the next report is due; none while the board is idle.
  [[nodiscard]] std::optional<std::uint64_t> nextDue_us() const;

  /// As pulled out and put in again: sequence, frames and clock begin anew, the configuration stays.
  void restart();
  /// Changed from then on.
  BoardFaults& faults() { return settings_.faults; }
  BoardDisturbance& disturbance() { return settings_.disturbance; }
  /// How much warmer it is than `startTemperature_degC`.
  [[nodiscard]] double warmth_degC() const { return temperature_degC() - settings_.disturbance.startTemperature_degC; }
  /// Before the first report: it does not begin cold.
  void beginWarm(double warmth_degC) { firstWarmth_degC_ = warmth_degC; }
  [[nodiscard]] const BoardInfo& info() const { return settings_.info; }
  [[nodiscard]] const BoardConfiguration& configuration() const { return settings_.configuration; }

private:
  using Send = std::function<void(std::span<const std::uint8_t>)>;
  Readings nextReadings(std::uint64_t clock_us);
  std::uint32_t code(int row, int column, double reference_ohm);
  /// Another warming than before begins now, from the present temperature.
  void followWarming();
  double disturbed(int row, int column, double resistance_ohm);
  [[nodiscard]] double temperature_degC() const;
  [[nodiscard]] int rangeOf(int row) const;
  [[nodiscard]] int nextRow(int after) const;
  void sendWithFaults(Report report, const Send& send);
  void answer(const BoardCommand& command);

  BoardSettings settings_;
  Resistances resistances_;
  const Eigen::MatrixXd* now_ohm_ = nullptr; ///< at the current frame
  Eigen::MatrixXd rest_ohm_;                 ///< of the first frame: what hysteresis compares with
  Eigen::MatrixXd play_;
  std::mt19937_64 engine_;
  std::normal_distribution<double> normal_;
  std::deque<BoardEvent> events_;
  std::optional<std::uint64_t> start_us_; ///< clock at the start
  std::uint64_t sent_ = 0;                ///< reports since the start of streaming
  std::uint64_t streamStart_us_ = 0;
  double time_s_ = 0;
  /// Warming that is under way: where to, and from where and when.
  struct Warming {
    double to_degC = 0, from_degC = 0; ///< above the start
    double begin_s = 0;
  };
  std::optional<Warming> warming_;
  double firstWarmth_degC_ = 0;
  std::uint16_t sequence_ = 0;
  std::uint16_t frame_ = 0;
  int row_ = 0;
  int firstColumn_ = 0;
  bool streaming_ = true;
};

} // namespace palp
