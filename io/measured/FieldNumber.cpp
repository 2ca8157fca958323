#include "io/measured/FieldNumber.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>

namespace palp {

namespace {

constexpr std::size_t kLongestNumber = 64;

/// Reads a date or time from the left.
class ClockText {
public:
  explicit ClockText(std::string_view text) : rest_(text) {}

  /// A whole number of at most N digits.
  std::optional<int> number(std::size_t mostDigits) {
    std::size_t digits = 0;
    while (digits < rest_.size() && rest_[digits] >= '0' && rest_[digits] <= '9') ++digits;
    if (digits == 0 || digits > mostDigits) return {};
    int value = 0;
    std::from_chars(rest_.data(), rest_.data() + digits, value);
    rest_.remove_prefix(digits);
    digits_ = digits;
    return value;
  }
  [[nodiscard]] std::size_t digits() const { return digits_; } ///< of the last number

  /// Removes the next letter if it is one of these.
  std::optional<char> oneOf(std::string_view letters) {
    if (rest_.empty() || letters.find(rest_.front()) == std::string_view::npos) return {};
    const char letter = rest_.front();
    rest_.remove_prefix(1);
    return letter;
  }
  [[nodiscard]] bool empty() const { return rest_.empty(); }
  void skipBlanks() {
    while (oneOf(" ")) {
    }
  }

private:
  std::string_view rest_;
  std::size_t digits_ = 0;
};

/// "16:14", "16:14:36", "16:14:36.25" [s]; the hour has been read.
std::optional<double> timeOfDay_s(ClockText& text, int hour) {
  if (!text.oneOf(":")) return {};
  const auto minute = text.number(2);
  if (!minute || hour > 24 || *minute > 59) return {};
  double seconds = 3600.0 * hour + 60.0 * *minute;
  if (!text.oneOf(":")) return seconds;
  const auto second = text.number(2);
  if (!second || *second > 60) return {};
  seconds += *second;
  if (!text.oneOf(".,")) return seconds;
  const auto fraction = text.number(9);
  if (!fraction) return {};
  return seconds + *fraction * std::pow(10.0, -static_cast<double>(text.digits()));
}

/// "Z", "+02:00", "+0200", "-5", or nothing [s].
std::optional<double> zone_s(ClockText& text) {
  text.skipBlanks();
  if (text.oneOf("Zz")) return 0;
  const auto sign = text.oneOf("+-");
  if (!sign) return 0;
  const auto hours = text.number(4);
  if (!hours) return {};
  double minutes = text.digits() > 2 ? *hours / 100 * 60 + *hours % 100 : *hours * 60;
  if (text.oneOf(":")) {
    const auto more = text.number(2);
    if (!more) return {};
    minutes += *more;
  }
  return (*sign == '-' ? -60 : 60) * minutes;
}

/// Days since 1970-01-01 of three numbers as they were read.
std::optional<double> days(std::array<int, 3> read, bool yearFirst, DateOrder order) {
  if (!yearFirst) {
    if (read[0] > 12) order = DateOrder::DayFirst;
    if (read[1] > 12) order = DateOrder::MonthFirst;
    if (order == DateOrder::Unknown && read[0] != read[1]) return {};
    read =
        order == DateOrder::MonthFirst ? std::array{read[2], read[0], read[1]} : std::array{read[2], read[1], read[0]};
    if (read[0] < 100) read[0] += 2000;
  }
  const std::chrono::year_month_day date{std::chrono::year(read[0]), std::chrono::month(static_cast<unsigned>(read[1])),
                                         std::chrono::day(static_cast<unsigned>(read[2]))};
  if (!date.ok()) return {};
  return static_cast<double>(std::chrono::sys_days(date).time_since_epoch().count());
}

} // namespace

std::string_view trimmedField(std::string_view text) {
  const auto trim = [&text] {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  };
  trim();
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') {
    text = text.substr(1, text.size() - 2);
    trim();
  }
  return text;
}

std::optional<double> fieldNumber(std::string_view field, char decimal) {
  if (field.starts_with('+')) field.remove_prefix(1);
  if (field.empty() || field.size() > kLongestNumber || field.starts_with('+')) return {};
  std::array<char, kLongestNumber> digits{};
  for (std::size_t i = 0; i < field.size(); ++i) {
    const char letter = field[i];
    if (letter == '.' && decimal != '.') return {};
    digits[i] = letter == decimal ? '.' : letter == 'D' || letter == 'd' ? 'e' : letter;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + field.size(), value);
  if (error != std::errc() || end != digits.data() + field.size() || !std::isfinite(value)) return {};
  return value;
}

std::optional<double> fieldClock_s(std::string_view field, DateOrder order) {
  ClockText text(field);
  const auto first = text.number(4);
  if (!first) return {};
  const bool yearFirst = text.digits() == 4;
  const auto separator = text.oneOf("-/.");
  if (!separator) { // a time of day
    const auto seconds = timeOfDay_s(text, *first);
    return text.empty() ? seconds : std::nullopt;
  }
  const auto second = text.number(2);
  if (!second || text.oneOf("-/.") != separator) return {};
  const auto third = text.number(yearFirst ? 2 : 4);
  if (!third || (!yearFirst && text.digits() != 2 && text.digits() != 4)) return {};
  const auto day = days({*first, *second, *third}, yearFirst, order);
  if (!day) return {};
  double seconds = 86400 * *day;
  if (text.empty()) return seconds;
  if (!text.oneOf("T")) text.skipBlanks();
  const auto hour = text.number(2);
  const auto ofDay = hour ? timeOfDay_s(text, *hour) : std::nullopt;
  const auto zone = ofDay ? zone_s(text) : std::nullopt;
  if (!zone || !text.empty()) return {};
  return seconds + *ofDay - *zone;
}

} // namespace palp
