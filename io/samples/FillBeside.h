#pragma once

#include "io/AtomicFile.h"

#include <functional>

namespace palp {

/// Lets `write` write the temporary file of `target`. Throws its Error, with the name of the file that was asked for in
/// place of the temporary one.
void fillBeside(const AtomicFile& target, const std::filesystem::path& path,
                const std::function<void(const std::filesystem::path&)>& write);

} // namespace palp
