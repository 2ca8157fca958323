#pragma once

#include "io/Decoder.h"

#include <filesystem>
#include <string>

namespace palp {

/// The decoder as JSON, 17 significant digits a number: reads back to the same bits.
std::string networkText(const Decoder& decoder);
/// `name` stands in the sentences of errors. Throws Error naming file and key: unknown key, missing key, wrong type,
/// sizes that do not fit together, a number that is none, a newer version, a truncated file.
Decoder parseNetwork(const std::string& text, const std::string& name);

/// Written beside and renamed.
void writeNetwork(const Decoder& decoder, const std::filesystem::path& file);
Decoder readNetwork(const std::filesystem::path& file);

} // namespace palp
