#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace palp {

/// A field of a line of CSV: in quotes where it has a comma, a quote or an end of line (RFC 4180).
std::string csvField(std::string_view text);
/// The same, always in quotes.
std::string quotedCsvField(std::string_view text);

/// The fields of a line, quotes removed; a comma, or another separator, in quotes is part of its field.
std::vector<std::string> csvFields(std::string_view line, char separator = ',');

} // namespace palp
