#include "io/send/Outlets.h"
#include "model/base/Error.h"

#include <lo/lo.h>

#include <memory>
#include <type_traits>

namespace palp {

namespace {

constexpr const char* kForcesPath = "/palp/forces_N";

// liblo's handles are pointers to void up to 0.31 and to structs from 0.32 on.
using OwnedAddress = std::unique_ptr<std::remove_pointer_t<lo_address>, decltype(&lo_address_free)>;
using OwnedMessage = std::unique_ptr<std::remove_pointer_t<lo_message>, decltype(&lo_message_free)>;

/// /palp/forces_N: device_s and host_unix_s (d), frame (h), valid and area (i, -1: none), then forces and their
/// standard deviations (f), x y z of each (Open Sound Control 1.0; liblo).
class OscOutlet : public ForceOutlet {
public:
  explicit OscOutlet(const Receiver& receiver)
      : address_(lo_address_new_with_proto(LO_UDP, receiver.host.c_str(), receiver.port.c_str()), lo_address_free) {
    if (!address_) throw Error(receiver.where + ": cannot be sent to");
  }

  bool send(const OutgoingFrame& frame, std::chrono::milliseconds /*patience*/) override {
    const OwnedMessage message(lo_message_new(), lo_message_free);
    lo_message_add_double(message.get(), frame.device_s);
    lo_message_add_double(message.get(), frame.host_unix_s);
    lo_message_add_int64(message.get(), static_cast<std::int64_t>(frame.frame));
    lo_message_add_int32(message.get(), frame.valid ? 1 : 0);
    lo_message_add_int32(message.get(), frame.valid ? frame.area.value_or(-1) : -1);
    if (frame.valid)
      for (const Eigen::Matrix3Xd* values : {&frame.forces_N, &frame.standardDeviation_N})
        for (const double value : values->reshaped()) lo_message_add_float(message.get(), static_cast<float>(value));
    return lo_send_message(address_.get(), kForcesPath, message.get()) > 0;
  }

private:
  OwnedAddress address_;
};

} // namespace

std::unique_ptr<ForceOutlet> openOsc(const Receiver& receiver) {
  return std::make_unique<OscOutlet>(receiver);
}

} // namespace palp
