#include "io/files/TemporaryName.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace palp {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kMark = ".new-";
constexpr std::size_t kLongestFileName = 255; // of a file, on Linux

/// Eight digits of this machine and its table of processes: a container has a table of its own.
std::string machine() {
  std::string identity;
  std::ifstream("/etc/machine-id") >> identity;
  std::array<char, 256> host{};
  ::gethostname(host.data(), host.size() - 1);
  std::error_code ignored;
  identity += std::string(host.data()) + fs::read_symlink("/proc/self/ns/pid", ignored).string();
  std::uint32_t hash = 2166136261; // FNV-1a
  for (const char c : identity) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619;
  std::array<char, 9> digits{"00000000"};
  std::array<char, 8> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), hash, 16).ptr;
  std::copy(text.data(), end, digits.data() + 8 - (end - text.data()));
  return digits.data();
}

/// The process in a temporary name of this machine; none for other names.
std::optional<pid_t> processOf(const std::string& name) {
  const std::string mark = std::string(kMark) + machine() + "-";
  const std::size_t at = name.rfind(mark);
  if (name.empty() || name[0] != '.' || at == std::string::npos) return {};
  const char* const end = name.data() + name.size();
  pid_t process = 0;
  const auto [afterProcess, noProcess] = std::from_chars(name.data() + at + mark.size(), end, process);
  if (noProcess != std::errc{} || process <= 0 || afterProcess == end || *afterProcess != '-') return {};
  int number = 0;
  const auto [afterNumber, noNumber] = std::from_chars(afterProcess + 1, end, number);
  if (noNumber != std::errc{} || (afterNumber != end && *afterNumber != '.')) return {};
  return process;
}

} // namespace

fs::path temporaryName(const fs::path& name, int number) {
  const std::string behind = std::string(kMark) + machine() + "-" + std::to_string(::getpid()) + "-" +
                             std::to_string(number) + name.extension().string();
  const std::size_t room = kLongestFileName - 1 - std::min(kLongestFileName - 1, behind.size());
  return "." + name.stem().string().substr(0, room) + behind;
}

bool isOwnTemporary(const fs::path& path) {
  std::error_code ignored;
  return processOf(path.filename().string()) == ::getpid() && fs::exists(path, ignored);
}

bool isOfEndedProcess(const fs::path& name) {
  const auto process = processOf(name.string());
  return process && ::kill(*process, 0) != 0 && errno == ESRCH;
}

} // namespace palp
