#include "app/study/Version.h"

#include "solver/InstructionSet.h"

#include <Eigen/Core>
#include <link.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

namespace palp {

extern const char* const kCommit; // Commit.cpp, made anew by CMake at each build of another commit

namespace {

/// How the files of the libraries that decide results begin; VTK and Qt each for their many parts.
constexpr std::array<std::string_view, 14> kNamed{
    "libtet.so",         "libcholmod.so", "libopenblas",   "libnlopt", "libhidapi-hidraw.so",
    "libhdf5_serial.so", "libdeflate.so", "libminizip.so", "liblo.so", "libzmq.so",
    "libvtkCommonCore-", "libQt6Core.so", "libGLEW.so",    "libgif.so"};

int addIfNamed(dl_phdr_info* loaded, std::size_t, void* names) {
  std::error_code none;
  const std::string file = std::filesystem::canonical(loaded->dlpi_name, none).filename().string();
  const bool named = std::any_of(kNamed.begin(), kNamed.end(), [&](std::string_view n) { return file.starts_with(n); });
  if (named) static_cast<std::vector<std::string>*>(names)->push_back(file);
  return 0;
}

/// Sorted file names, links followed, as libtet.so.1.5.0.
std::vector<std::string> loadedLibraries() {
  std::vector<std::string> names;
  dl_iterate_phdr(addIfNamed, &names);
  std::sort(names.begin(), names.end());
  return names;
}

std::string numbers(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

} // namespace

std::string version() {
  return PALP_VERSION;
}

std::string program() {
  return "palp " + version() + " (commit " + kCommit + ")";
}

std::string programHere() {
  return program() + ", " + instructionSetName();
}

std::string versionInWords() {
  std::string words = program() + "\nbuilt by g++ " __VERSION__ " with Eigen " +
                      numbers(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION) + " and nlohmann-json " +
                      numbers(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH);
  const char* separator = "\nloaded: ";
  for (const std::string& file : loadedLibraries()) {
    words += separator + file;
    separator = ", ";
  }
  return words;
}

} // namespace palp
