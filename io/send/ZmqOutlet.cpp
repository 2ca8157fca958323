#include "io/send/Outlets.h"
#include "io/send/SingleHost.h"
#include "model/base/Error.h"

#include <zmq.h>

#include <array>
#include <cstring>

namespace palp {

namespace {

constexpr int kKeptMessages = 1000;                   ///< of a subscriber that is slow; what is more is lost
constexpr const char* kEvents = "inproc://connected"; ///< of the publisher's socket

using ZmqSocket = std::unique_ptr<void, decltype(&zmq_close)>;

/// The addresses of a receiver as ZeroMQ has them: a name such as localhost has several, of which a subscriber is bound
/// to one.
std::vector<std::string> endpointsOf(const Receiver& receiver) {
  std::vector<std::string> endpoints;
  const Addresses all = addressesOf(receiver);
  for (const addrinfo* address : inOrder(all.get())) {
    std::array<char, NI_MAXHOST> number{};
    if (getnameinfo(address->ai_addr, address->ai_addrlen, number.data(), number.size(), nullptr, 0, NI_NUMERICHOST) !=
        0)
      continue;
    const std::string host = address->ai_family == AF_INET6 ? "[" + std::string(number.data()) + "]" : number.data();
    endpoints.push_back("tcp://" + host + ":" + receiver.port);
  }
  return endpoints;
}

/// The JSON of a datagram as one message of a publisher (ZeroMQ PUB), which connects to a subscriber that is bound: to
/// the first of its addresses that answers, so that one that is bound to all of them gets each frame once.
class ZmqOutlet : public ForceOutlet {
public:
  explicit ZmqOutlet(const Receiver& receiver)
      : context_(zmq_ctx_new(), zmq_ctx_term), socket_(zmq_socket(context_.get(), ZMQ_PUB), zmq_close),
        events_(zmq_socket(context_.get(), ZMQ_PAIR), zmq_close), endpoints_(endpointsOf(receiver)) {
    const int no = 0, yes = 1;
    const int watched = ZMQ_EVENT_HANDSHAKE_SUCCEEDED | ZMQ_EVENT_DISCONNECTED;
    if (!socket_ || !events_ || zmq_setsockopt(socket_.get(), ZMQ_LINGER, &no, sizeof no) != 0 ||
        zmq_setsockopt(socket_.get(), ZMQ_IPV6, &yes, sizeof yes) != 0 ||
        zmq_setsockopt(socket_.get(), ZMQ_SNDHWM, &kKeptMessages, sizeof kKeptMessages) != 0 ||
        zmq_socket_monitor(socket_.get(), kEvents, watched) != 0 || zmq_connect(events_.get(), kEvents) != 0 ||
        !connectAll())
      throw Error(receiver.where + ": cannot be sent to: " + zmq_strerror(zmq_errno()));
  }

  bool send(const OutgoingFrame& frame, std::chrono::milliseconds /*patience*/) override {
    followEvents();
    if (connected_.empty()) return false; // nobody is bound there
    const std::string json = frameAsJson(frame);
    return zmq_send(socket_.get(), json.data(), json.size(), ZMQ_DONTWAIT) >= 0;
  }

  /// The library's own thread sends; what it cannot keep is lost.
  [[nodiscard]] bool mayWait() const override { return false; }

private:
  bool connectAll() {
    bool any = false;
    for (const std::string& endpoint : endpoints_)
      if (endpoint != connected_) any = zmq_connect(socket_.get(), endpoint.c_str()) == 0 || any;
    return any;
  }

  /// What became of the connections since.
  void followEvents() {
    std::array<char, 6> event{}; // u16 event, u32 value
    std::array<char, 256> address{};
    while (zmq_recv(events_.get(), event.data(), event.size(), ZMQ_DONTWAIT) == static_cast<int>(event.size())) {
      const int length = zmq_recv(events_.get(), address.data(), address.size(), 0);
      std::uint16_t what = 0;
      std::memcpy(&what, event.data(), sizeof what);
      follow(what, {address.data(), static_cast<std::size_t>(std::max(length, 0))});
    }
  }

  void follow(std::uint16_t what, const std::string& endpoint) {
    if (what == ZMQ_EVENT_HANDSHAKE_SUCCEEDED && connected_.empty()) {
      connected_ = endpoint;
      for (const std::string& other : endpoints_)
        if (other != endpoint) zmq_disconnect(socket_.get(), other.c_str());
    } else if (what == ZMQ_EVENT_DISCONNECTED && endpoint == connected_) {
      connectAll(); // this one is tried again by the library
      connected_.clear();
    }
  }

  std::unique_ptr<void, decltype(&zmq_ctx_term)> context_;
  ZmqSocket socket_, events_;
  std::vector<std::string> endpoints_;
  std::string connected_; ///< that is bound; empty: none
};

} // namespace

std::unique_ptr<ForceOutlet> openZmq(const Receiver& receiver) {
  return std::make_unique<ZmqOutlet>(receiver);
}

} // namespace palp
