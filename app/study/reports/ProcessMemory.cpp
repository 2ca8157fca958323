#include "app/study/reports/ProcessMemory.h"

#include <fstream>
#include <string>

namespace palp {

namespace {

/// A line of /proc/self/status, in MB; it is written in kB.
double statusLine_MB(const std::string& name) {
  std::ifstream file("/proc/self/status");
  for (std::string word; file >> word;) {
    double value_kB = 0;
    if (word == name && file >> value_kB) return value_kB / 1024;
  }
  return 0;
}

} // namespace

double heldMemory_MB() {
  return statusLine_MB("VmRSS:");
}

double peakMemory_MB() {
  return statusLine_MB("VmHWM:");
}

void resetPeakMemory() {
  std::ofstream("/proc/self/clear_refs") << 5; // proc(5): resets VmHWM
}

} // namespace palp
