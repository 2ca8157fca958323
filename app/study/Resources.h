#pragma once

#include <filesystem>
#include <string>

namespace palp {

/// A file that ships with Palp, "board/paper-samples.csv": next to an installation's bin folder (share/palp), in the
/// sources above build/bin wherever they were moved to, in those that this program was built from, or in the Debian
/// package. Throws Error where it is in none, which names the file and the places.
std::filesystem::path resource(const std::string& name);

} // namespace palp
