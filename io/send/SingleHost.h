#pragma once

// Private to io.

#include "io/send/Outlets.h"

#include <netdb.h>

#include <memory>
#include <vector>

namespace palp {

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

/// The addresses of a receiver of datagrams, at least one. Throws Error where its name is not known.
Addresses addressesOf(const Receiver& receiver);

/// In the order in which they are tried: an address of this computer by IPv4 before the others, as most programs listen
/// to that.
std::vector<const addrinfo*> inOrder(const addrinfo* all);

/// Throws Error where the receiver is a multicast address or one of the broadcasts of this computer's networks.
void requireSingleHost(const Receiver& receiver);

} // namespace palp
