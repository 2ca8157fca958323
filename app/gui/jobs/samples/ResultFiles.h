#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <filesystem>
#include <functional>
#include <set>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Tries the network on the test samples, with the noise of the test that its settings say. Throws Error where it does
/// not fit them, and Cancelled.
void tryOn(NetworkFit& fit, const NetworkSamples& samples, const std::stop_token& stop);

/// The decoder tried on the test samples, without noise. Throws Error where it does not fit them.
std::shared_ptr<const NetworkFit> triedOn(Decoder decoder, const NetworkSamples& samples);

/// The files of a folder that hold what is there now: samples.csv, samples-test.csv, network.json and
/// sweeps.json.
std::set<std::filesystem::path> resultFiles(const std::filesystem::path& folder);

/// Samples, networks, sweep and comparison of a design in a folder of their own, which is made: resultFiles() and, in
/// networks, those that can be gone back to, each with the settings it was trained with. All of it or, where it cannot
/// be written, no existing file is changed. Networks leave the folder only where the user removed them, and of
/// resultFiles() only `ours` are replaced, whose content is held or was written before: others that hold something else
/// are kept under the name of this moment. Returns a sentence for each of them. Throws Error.
std::vector<std::string> saveResults(const std::filesystem::path& folder, const NetworkResults& results,
                                     const std::set<std::filesystem::path>& ours);

/// What a folder held.
struct OpenedResults {
  NetworkResults results;
  std::set<std::filesystem::path> opened; ///< of resultFiles(): whose content the results hold
  std::vector<std::string> problems;      ///< a sentence for each file that cannot be opened
  int ofOtherDesigns = 0;                 ///< networks there that are not listed
};

/// Share 0..1 of the opening, and what is opened.
using OpeningProgress = std::function<void(double share, const std::string& what)>;

/// What saveResults() wrote; nothing where the folder holds no samples. What cannot be opened is left out, and so are
/// networks without a name beyond those that a list keeps.
OpenedResults openResults(
    const std::filesystem::path& folder, const SensorDesign& design, const std::stop_token& stop,
    const OpeningProgress& progress = [](double, const std::string&) {});

} // namespace palp
