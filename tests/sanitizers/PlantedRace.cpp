// A data race on purpose: tests/run --all asks the thread sanitizer to find it, so that its silence elsewhere counts.
// Every chunk adds to the same sum; that each of two threads gets one of the two chunks is made sure of.

#include "model/base/Parallel.h"

#include <chrono>
#include <iostream>
#include <thread>

int main() {
  int sum = 0;
  palp::inParallel(2, 2, [&](std::size_t i) {
    sum += static_cast<int>(i) + 1; // not guarded
    std::this_thread::sleep_for(std::chrono::seconds(1));
  });
  std::cout << sum << '\n';
  return 0;
}
