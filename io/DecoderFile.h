#pragma once

#include "io/Decoder.h"

#include <filesystem>
#include <string>

namespace palp {

/// The decoder as the text of its JSON file; numbers read back to the same bits.
std::string networkText(const Decoder& decoder);
/// `file` is the name for error messages. Throws Error naming file and key: unknown key, missing key, wrong type, sizes
/// that do not fit together, a newer version, a truncated file.
Decoder parseNetwork(const std::string& json, const std::string& file);

/// Throws Error.
Decoder readNetwork(const std::filesystem::path& path);
/// Written as AtomicFile does. Throws Error if the file exists and `force` is false.
void writeNetwork(const Decoder& decoder, const std::filesystem::path& path, bool force = true);

} // namespace palp
