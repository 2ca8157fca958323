#include "io/send/Outlets.h"
#include "io/send/SingleHost.h"
#include "model/base/Error.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace palp {

namespace {

std::string networkReason() {
  return std::strerror(errno); // NOLINT(concurrency-mt-unsafe)
}

bool isMulticast(const sockaddr* address) {
  if (address->sa_family == AF_INET6)
    return IN6_IS_ADDR_MULTICAST(&reinterpret_cast<const sockaddr_in6*>(address)->sin6_addr);
  return IN_MULTICAST(ntohl(reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr));
}

/// 255.255.255.255, or the last address of one of this computer's networks.
bool isBroadcast(const sockaddr* address) {
  if (address->sa_family != AF_INET) return false;
  const in_addr_t number = reinterpret_cast<const sockaddr_in*>(address)->sin_addr.s_addr;
  if (number == INADDR_BROADCAST) return true;
  ifaddrs* all = nullptr;
  if (getifaddrs(&all) != 0) return false;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> held(all, freeifaddrs);
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next)
    if ((one->ifa_flags & IFF_BROADCAST) != 0 && one->ifa_broadaddr != nullptr &&
        one->ifa_broadaddr->sa_family == AF_INET &&
        reinterpret_cast<const sockaddr_in*>(one->ifa_broadaddr)->sin_addr.s_addr == number)
      return true;
  return false;
}

/// One JSON object a datagram, as PlotJuggler's UDP server reads it.
class UdpOutlet : public ForceOutlet {
public:
  UdpOutlet(const Receiver& receiver, bool toMany) {
    const Addresses addresses = addressesOf(receiver);
    socket_ = ::socket(addresses->ai_family, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    const int yes = 1;
    if (socket_ >= 0 && toMany) setsockopt(socket_, SOL_SOCKET, SO_BROADCAST, &yes, sizeof yes);
    if (socket_ >= 0 && ::connect(socket_, addresses->ai_addr, addresses->ai_addrlen) == 0) return;
    const std::string reason = networkReason();
    if (socket_ >= 0) ::close(socket_);
    throw Error(receiver.where + ": cannot be sent to: " + reason);
  }
  ~UdpOutlet() override { ::close(socket_); }
  UdpOutlet(const UdpOutlet&) = delete;
  UdpOutlet& operator=(const UdpOutlet&) = delete;

  bool send(const OutgoingFrame& frame, std::chrono::milliseconds /*patience*/) override {
    const std::string json = frameAsJson(frame);
    return ::send(socket_, json.data(), json.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(json.size());
  }

  /// The socket is not blocking: a datagram goes at once or is lost.
  [[nodiscard]] bool mayWait() const override { return false; }

private:
  int socket_ = -1;
};

} // namespace

Addresses addressesOf(const Receiver& receiver) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int result = getaddrinfo(receiver.host.c_str(), receiver.port.c_str(), &wanted, &found);
  if (result != 0 || found == nullptr)
    throw Error(receiver.where + ": host " + receiver.host + " is not known: " + gai_strerror(result));
  return {found, freeaddrinfo};
}

void requireSingleHost(const Receiver& receiver) {
  const Addresses addresses = addressesOf(receiver);
  for (const addrinfo* one = addresses.get(); one != nullptr; one = one->ai_next)
    if (isMulticast(one->ai_addr) || isBroadcast(one->ai_addr))
      throw Error(receiver.where + ": is an address of many receivers; allowed is one, or --send-to-many");
}

std::unique_ptr<ForceOutlet> openUdp(const Receiver& receiver, bool toMany) {
  return std::make_unique<UdpOutlet>(receiver, toMany);
}

} // namespace palp
