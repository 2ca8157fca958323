#include "io/send/DatagramSocket.h"

#include <lo/lo.h>

#include <cstdlib>
#include <memory>
#include <type_traits>

namespace palp {

namespace {

// liblo's messages are pointers to void up to 0.31 and to structs from 0.32 on.
using OwnedMessage = std::unique_ptr<std::remove_pointer_t<lo_message>, decltype(&lo_message_free)>;
using OwnedBytes = std::unique_ptr<void, decltype(&std::free)>;

/// Two messages a frame (Open Sound Control 1.0, written by liblo). /palp/forces_N has the types that every receiver
/// reads: frame, valid, area (i; -1: none), device_s (f), forces and their standard deviations (f), x y z of each.
/// /palp/time_s has the times to the last digit: frame (i), device_s and host_unix_s (d).
class OscOutlet : public ForceOutlet {
public:
  explicit OscOutlet(const Receiver& receiver, bool toMany) : socket_(receiver, toMany) {}

  bool send(const OutgoingFrame& frame, std::chrono::milliseconds /*patience*/) override {
    const OwnedMessage forces(lo_message_new(), lo_message_free), time(lo_message_new(), lo_message_free);
    const auto number = static_cast<std::int32_t>(frame.frame);
    lo_message_add_int32(forces.get(), number);
    lo_message_add_int32(forces.get(), frame.valid ? 1 : 0);
    lo_message_add_int32(forces.get(), frame.valid ? frame.area.value_or(-1) : -1);
    lo_message_add_float(forces.get(), static_cast<float>(frame.device_s));
    if (frame.valid)
      for (const Eigen::Matrix3Xd* values : {&frame.forces_N, &frame.standardDeviation_N})
        for (const double value : values->reshaped()) lo_message_add_float(forces.get(), static_cast<float>(value));
    lo_message_add_int32(time.get(), number);
    lo_message_add_double(time.get(), frame.device_s);
    lo_message_add_double(time.get(), frame.host_unix_s);
    return send("/palp/forces_N", forces.get()) && send("/palp/time_s", time.get());
  }

  [[nodiscard]] bool mayWait() const override { return false; }

private:
  bool send(const char* path, lo_message message) {
    std::size_t count = 0;
    const OwnedBytes bytes(lo_message_serialise(message, path, nullptr, &count), std::free);
    return bytes && socket_.send(bytes.get(), count);
  }

  DatagramSocket socket_;
};

} // namespace

std::unique_ptr<ForceOutlet> openOsc(const Receiver& receiver, bool toMany) {
  return std::make_unique<OscOutlet>(receiver, toMany);
}

} // namespace palp
