#include "io/send/DatagramSocket.h"
#include "io/send/SingleHost.h"
#include "model/base/Error.h"
#include "model/base/GotExpected.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>

namespace palp {

namespace {

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

bool isLoopback4(const addrinfo* address) {
  if (address->ai_family != AF_INET) return false;
  return ntohl(reinterpret_cast<const sockaddr_in*>(address->ai_addr)->sin_addr.s_addr) >> 24 == IN_LOOPBACKNET;
}

/// One JSON object a datagram, as PlotJuggler's UDP server reads it.
class UdpOutlet : public ForceOutlet {
public:
  UdpOutlet(const Receiver& receiver, bool toMany) : socket_(receiver, toMany) {}

  bool send(const OutgoingFrame& frame, std::chrono::milliseconds /*patience*/) override {
    const std::string json = frameAsJson(frame);
    return socket_.send(json.data(), json.size());
  }

  [[nodiscard]] bool mayWait() const override { return false; }

private:
  DatagramSocket socket_;
};

} // namespace

Addresses addressesOf(const Receiver& receiver) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int result = getaddrinfo(receiver.host.c_str(), receiver.port.c_str(), &wanted, &found);
  if (result != 0 || found == nullptr)
    throw Error(receiver.where + ": host " + receiver.host + " is unknown: " + gai_strerror(result));
  return {found, freeaddrinfo};
}

std::vector<const addrinfo*> inOrder(const addrinfo* all) {
  std::vector<const addrinfo*> addresses;
  for (const addrinfo* one = all; one != nullptr; one = one->ai_next) addresses.push_back(one);
  std::stable_partition(addresses.begin(), addresses.end(), isLoopback4);
  return addresses;
}

void requireSingleHost(const Receiver& receiver) {
  const Addresses addresses = addressesOf(receiver);
  for (const addrinfo* one = addresses.get(); one != nullptr; one = one->ai_next)
    if (isMulticast(one->ai_addr) || isBroadcast(one->ai_addr))
      throw Error(receiver.where + ": " +
                  gotExpected("a broadcast or multicast address", "one receiver, or --send-to-many"));
}

std::unique_ptr<ForceOutlet> openUdp(const Receiver& receiver, bool toMany) {
  return std::make_unique<UdpOutlet>(receiver, toMany);
}

} // namespace palp
