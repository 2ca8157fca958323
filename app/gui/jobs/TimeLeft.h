#pragma once

#include <QElapsedTimer>
#include <QString>

#include <optional>

namespace palp {

/// "8 s", "40 s", "2.5 min": at most a sixth away from the number.
QString roughly(double seconds);

/// Remaining time of work whose steps take about as long each: as long as the measured ones. What comes between
/// (meshing, factorising) does not count as steps. The time now is handed in, in seconds since any moment.
class TimeLeft {
public:
  /// Steps begin, or go on; `done` of them were done before.
  void begin(double done, double now_s);
  /// Until begin() no step is made.
  void pause(double done, double now_s);
  /// None before the first step is done.
  [[nodiscard]] std::optional<double> left_s(double done, double all, double now_s) const;

private:
  double seen_ = 0, took_s_ = 0; ///< steps and their time before the last begin()
  double from_ = 0, since_s_ = 0;
};

/// Remaining time of work that reports its share of the time, at its pace until now.
class LeftOfShares {
public:
  LeftOfShares() { clock_.start(); }
  /// None in the first seconds, and while there is too little to go by.
  [[nodiscard]] std::optional<double> at(double share) const;

private:
  QElapsedTimer clock_;
};

/// ", about 40 s left", or nothing.
std::string leftInWords(std::optional<double> left_s);

} // namespace palp
