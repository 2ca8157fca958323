#pragma once

#include "model/base/Error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

namespace palp {

/// The system's message for an error number, by default that of the last call.
inline std::string systemMessage(int error = errno) {
  return std::strerror(error); // NOLINT(concurrency-mt-unsafe): glibc's is safe for known numbers
}

/// Throws Error that the file cannot be written, or read, with the system's message.
[[noreturn]] inline void cannotWrite(const std::filesystem::path& path, const std::string& reason = systemMessage()) {
  throw Error(path.string() + ": cannot be written: " + reason);
}
[[noreturn]] inline void cannotRead(const std::filesystem::path& path, const std::string& reason = systemMessage()) {
  throw Error(path.string() + ": cannot be read: " + reason);
}

} // namespace palp
