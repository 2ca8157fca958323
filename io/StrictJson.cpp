#include "io/StrictJson.h"

#include "model/base/Error.h"
#include "model/base/GotExpected.h"
#include "model/base/Text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace palp {

namespace {

constexpr std::size_t kLongestShownValue = 60;
constexpr int kDeepest = 50; ///< our own files are at most 6 deep; writing a value calls itself once a level

/// Looks at what the parser would take silently: the last of two equal keys, and any depth. Remembers the keys of the
/// objects that are open.
class ParseGuard {
public:
  explicit ParseGuard(const std::string& file) : file_(file) {}

  bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
    if (depth > kDeepest)
      throw Error(
          file_ + ": nested lists and objects: " +
          gotExpected("more than " + std::to_string(kDeepest) + " levels", "up to " + std::to_string(kDeepest)));
    if (event == Json::parse_event_t::object_start) open_.emplace_back();
    if (event == Json::parse_event_t::object_end) open_.pop_back();
    if (event == Json::parse_event_t::key && !open_.back().insert(parsed.get<std::string>()).second)
      throw Error(file_ + ": key \"" + parsed.get<std::string>() + "\" appears twice");
    return true;
  }

private:
  const std::string& file_;
  std::vector<std::set<std::string>> open_;
};

std::string keyList(const std::vector<std::string>& words) {
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  return all;
}

/// The library's message without its own tag in brackets.
std::string plain(const std::string& message) {
  const std::size_t end = message.find("] ");
  return end == std::string::npos ? message : message.substr(end + 2);
}

/// That the file ends before its JSON does, with the line; empty where the error is within it.
std::string cutOff(std::string_view content, const Json::exception& broken) {
  const auto* at = dynamic_cast<const Json::parse_error*>(&broken);
  if (at == nullptr || at->byte <= content.size()) return {};
  const std::size_t last = content.find_last_not_of(" \t\r\n");
  if (last == std::string_view::npos) return "the file is empty";
  const auto line = 1 + std::count(content.begin(), content.begin() + static_cast<std::ptrdiff_t>(last), '\n');
  return "the file ends early, at line " + std::to_string(line) + ": it was cut off, or not written completely";
}

} // namespace

Json parseJson(std::string_view content, const std::string& file) {
  ParseGuard guard(file);
  try {
    return Json::parse(content,
                       [&](int depth, Json::parse_event_t event, Json& parsed) { return guard(depth, event, parsed); });
  } catch (const Json::exception& broken) {
    const std::string cut = cutOff(content, broken);
    if (content.starts_with("# palp_samples"))
      throw Error(file + ": not valid JSON: it contains samples (CSV); check for swapped file names");
    throw Error(file + ": not valid JSON: " + (cut.empty() ? plain(broken.what()) : cut));
  }
}

void JsonPlace::refuse(const std::string& allowed) const {
  std::string value = jsonText(*value_);
  if (value.size() > kLongestShownValue) value = value.substr(0, kLongestShownValue) + "...";
  throw Error(file_ + ": " + (key_.empty() ? "" : key_ + ": ") + gotExpected(value, allowed));
}

const JsonPlace& JsonPlace::onlyKeys(const std::vector<std::string>& required,
                                     const std::vector<std::string>& optional) const {
  std::vector<std::string> known = required;
  known.insert(known.end(), optional.begin(), optional.end());
  if (!value_->is_object()) refuse("an object with the keys " + keyList(known));
  const std::string prefix = key_.empty() ? "" : key_ + ".";
  for (const auto& [key, value] : value_->items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      JsonPlace(value, file_, "unknown key " + prefix + key).refuse("one of the keys " + keyList(known));
  for (const std::string& key : required)
    if (!value_->contains(key))
      throw Error(file_ + ": " + prefix + key + " is missing; expected the keys " + keyList(required));
  return *this;
}

JsonPlace JsonPlace::at(const std::string& key) const {
  const std::string path = key_.empty() ? key : key_ + "." + key;
  if (!has(key)) throw Error(file_ + ": " + path + " is missing");
  return {(*value_)[key], file_, path};
}

double JsonPlace::number() const {
  if (!value_->is_number()) refuse("a number");
  return value_->get<double>();
}

double JsonPlace::number(double low, double high) const {
  const double value = value_->is_number() ? value_->get<double>() : std::nan("");
  if (!(value >= low && value <= high)) refuse("a number from " + text(low) + " to " + text(high));
  return value;
}

int JsonPlace::integer() const {
  constexpr int largest = std::numeric_limits<int>::max();
  return integer(-largest, largest);
}

int JsonPlace::integer(int low, int high) const {
  const double value = value_->is_number() ? value_->get<double>() : std::nan("");
  if (!(value >= low && value <= high) || value != std::floor(value))
    refuse("a whole number from " + text(low) + " to " + text(high));
  return static_cast<int>(value);
}

bool JsonPlace::boolean() const {
  if (!value_->is_boolean()) refuse("true or false");
  return value_->get<bool>();
}

std::string JsonPlace::string() const {
  if (!value_->is_string()) refuse("a text");
  return value_->get<std::string>();
}

std::vector<double> JsonPlace::numbers() const {
  if (!value_->is_array()) refuse("a list of numbers");
  std::vector<double> values;
  values.reserve(value_->size());
  for (const Json& entry : *value_) {
    if (!entry.is_number())
      JsonPlace(entry, file_, key_ + "[" + std::to_string(values.size()) + "]").refuse("a number");
    values.push_back(entry.get<double>());
  }
  return values;
}

std::vector<double> JsonPlace::numbers(std::size_t count) const {
  std::vector<double> values = numbers();
  if (values.size() != count) refuse("a list of " + std::to_string(count) + " numbers");
  return values;
}

std::vector<JsonPlace> JsonPlace::list() const {
  if (!value_->is_array()) refuse("a list");
  std::vector<JsonPlace> places;
  places.reserve(value_->size());
  for (const Json& entry : *value_) places.emplace_back(entry, file_, key_ + "[" + std::to_string(places.size()) + "]");
  return places;
}

int formatVersion(const JsonPlace& root, const std::string& key, int newest) {
  const JsonPlace place = root.at(key);
  const int version = place.integer();
  if (version > newest) place.refuse("up to " + std::to_string(newest) + "; a newer Palp wrote this file");
  if (version < 1) place.refuse("1 to " + std::to_string(newest));
  return version;
}

} // namespace palp
