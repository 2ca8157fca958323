#pragma once

#include <string>

namespace palp {

/// This program's version, as "1.0.0".
std::string version();

/// Version and commit in one line: what the parts of long work say who made them.
std::string program();

/// The same with the instruction set of the solver here: what decides the last digits of a result.
std::string programHere();

/// What a report of a fault should begin with: version, the commit that was built (with "+" where files differed from
/// it; "unknown" outside of git), compiler, and the libraries that are loaded, by their files.
std::string versionInWords();

} // namespace palp
