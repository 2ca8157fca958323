#pragma once

#include <filesystem>
#include <string>

namespace palp {

/// A file that ships with Palp, "board/paper-samples.csv": beside an installation's bin folder (share/palp), else in
/// the sources that this program was built from. Throws Error where it is in neither.
std::filesystem::path resource(const std::string& name);

} // namespace palp
