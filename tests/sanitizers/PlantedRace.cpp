// A data race on purpose: tests/run --all asks the thread sanitizer to find it, so that its silence elsewhere counts.

#include "model/base/Parallel.h"

#include <iostream>

int main() {
  int sum = 0;
  palp::inParallel(1000, 4, [&](std::size_t i) { sum += static_cast<int>(i); }); // not guarded
  std::cout << sum << '\n';
  return 0;
}
