#include "io/send/Outlets.h"
#include "model/base/Error.h"

#include <zmq.h>

namespace palp {

namespace {

constexpr int kKeptMessages = 1000; ///< of a subscriber that is slow; what is more is lost

/// The JSON of a datagram as one message of a publisher (ZeroMQ PUB), which connects to a subscriber that is bound.
class ZmqOutlet : public ForceOutlet {
public:
  explicit ZmqOutlet(const Receiver& receiver)
      : context_(zmq_ctx_new(), zmq_ctx_term), socket_(zmq_socket(context_.get(), ZMQ_PUB), zmq_close) {
    const int no = 0, yes = 1;
    const bool numeric6 = receiver.host.find(':') != std::string::npos;
    const std::string host = numeric6 ? "[" + receiver.host + "]" : receiver.host;
    if (!socket_ || zmq_setsockopt(socket_.get(), ZMQ_LINGER, &no, sizeof no) != 0 ||
        zmq_setsockopt(socket_.get(), ZMQ_IPV6, &yes, sizeof yes) != 0 ||
        zmq_setsockopt(socket_.get(), ZMQ_SNDHWM, &kKeptMessages, sizeof kKeptMessages) != 0 ||
        zmq_connect(socket_.get(), ("tcp://" + host + ":" + receiver.port).c_str()) != 0)
      throw Error(receiver.where + ": cannot be sent to: " + zmq_strerror(zmq_errno()));
  }

  bool send(const OutgoingFrame& frame, std::chrono::milliseconds /*patience*/) override {
    const std::string json = frameAsJson(frame);
    return zmq_send(socket_.get(), json.data(), json.size(), ZMQ_DONTWAIT) >= 0;
  }

  /// The library's own thread sends; what it cannot keep is lost.
  [[nodiscard]] bool mayWait() const override { return false; }

private:
  std::unique_ptr<void, decltype(&zmq_ctx_term)> context_;
  std::unique_ptr<void, decltype(&zmq_close)> socket_;
};

} // namespace

std::unique_ptr<ForceOutlet> openZmq(const Receiver& receiver) {
  return std::make_unique<ZmqOutlet>(receiver);
}

} // namespace palp
