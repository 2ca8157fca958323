#pragma once

#include <malloc.h>

namespace palp {

/// What was freed goes back to the system: the C library would keep most of it, hundreds of megabytes after a solve.
inline void returnMemory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

} // namespace palp
