#pragma once

// Private to io: what one field of a table of text means.

#include <optional>
#include <string_view>

namespace palp {

/// Without blanks around it, and without one pair of quotes.
std::string_view trimmedField(std::string_view text);

/// A number in the forms that loggers write: "1.5", "+1,5" with `decimal` ',', "1.5D+03". Nothing for words and for
/// what is not finite.
std::optional<double> fieldNumber(std::string_view field, char decimal);

/// Order of day and month in dates with slashes or points; Unknown refuses a date that can be read in both ways.
enum class DateOrder { Unknown, DayFirst, MonthFirst };

/// A date with or without time of day, or a time of day alone, as seconds since 1970-01-01 UTC, or since midnight:
/// "2017-07-31T16:14:36+02:00", "2021/3/5 12:34", "31.07.2017 16:14:36,25", "16:14:36.250". Nothing for anything else.
std::optional<double> fieldClock_s(std::string_view field, DateOrder order);

} // namespace palp
