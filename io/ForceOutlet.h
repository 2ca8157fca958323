#pragma once

#include <Eigen/Core>

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace palp {

/// What other programs get of one frame of a board (resources/docs/formats.md, Live forces).
struct OutgoingFrame {
  double device_s = 0;                  ///< device clock at the first reading
  double host_unix_s = 0;               ///< host clock when the forces were decoded, since 1970-01-01 UTC
  std::uint64_t frame = 0;              ///< number, as the board counts
  bool valid = false;                   ///< false: there are no forces
  Eigen::Matrix3Xd forces_N;            ///< 3 x 1, or 3 x areas
  Eigen::Matrix3Xd standardDeviation_N; ///< of each; may be empty
  std::optional<int> area;              ///< most likely touched
  std::optional<Eigen::Vector2d> place_mm{}, placeDeviation_mm{}; ///< of the touch, from the block's corner
  bool doubted = false;                                           ///< for a while now forces can hardly be true
};

/// One JSON object without an end of line: what goes by UDP and ZeroMQ. Forces only where they are valid.
std::string frameAsJson(const OutgoingFrame& frame);
/// Names of the columns, with the end of line, of this many forces; and the line of a frame, whose forces are empty
/// fields where they are not valid.
std::string frameCsvHead(Eigen::Index forces);
std::string frameAsCsv(const OutgoingFrame& frame, Eigen::Index forces);

/// Where frames go: one receiver. Used by one thread at a time, which it may not hold up for longer than `patience`.
class ForceOutlet {
public:
  ForceOutlet() = default;
  virtual ~ForceOutlet() = default;
  ForceOutlet(const ForceOutlet&) = delete;
  ForceOutlet& operator=(const ForceOutlet&) = delete;

  /// Whether the frame was handed to the system; false: nobody takes it now, and it is lost.
  virtual bool send(const OutgoingFrame& frame, std::chrono::milliseconds patience) = 0;
  /// Why nothing is taken any more, and never will be: the disk is full. Empty while all is well.
  [[nodiscard]] virtual std::string failure() const { return {}; }
  /// Whether send() may wait for the receiver, so that it needs a thread of its own.
  [[nodiscard]] virtual bool mayWait() const { return true; }
};

/// Such a receiver is a program of this computer, by its address alone: no file, no other host, no stream that is made
/// known in the network.
bool staysOnThisComputer(const std::string& where);

/// "udp:HOST:PORT", "osc:HOST:PORT", "zmq:HOST:PORT" (a publisher that connects to a subscriber which is bound there),
/// "csv:FILE" ("csv:-": standard output; a FIFO is waited for) or "lsl:NAME" (a stream of the Lab Streaming Layer,
/// whose library is loaded). Only sends, nothing is listened on, but by that library, which answers searches for its
/// streams. Throws Error with what is allowed; broadcast and multicast addresses only where they are requested by
/// `toMany`, and a file that exists with `force`.
std::unique_ptr<ForceOutlet> openOutlet(const std::string& where, bool toMany, bool force);

} // namespace palp
