#pragma once

// Private to io: names of temporary files, .NAME.new-MACHINE-PROCESS-NUMBER.ENDING.

#include <filesystem>

namespace palp {

/// The name under which this process writes the file `name` until it is complete: unique across the machines that share
/// a folder, together with exclusive creation. Keeps the ending.
std::filesystem::path temporaryName(const std::filesystem::path& name, int number);

/// Whether it is the temporary file of this process, and exists.
bool isOwnTemporary(const std::filesystem::path& path);

/// Whether it is the name of a temporary file of a process of this machine that does not run any more.
bool isOfEndedProcess(const std::filesystem::path& name);

} // namespace palp
