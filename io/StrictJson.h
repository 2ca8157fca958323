#pragma once

// For sources only: keeps nlohmann-json out of every other header.

#include <nlohmann/json.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace palp {

using Json = nlohmann::json;

/// Parses JSON. Throws Error with line and column where it is broken, with the key that appears twice, or where objects
/// and lists lie deeper in each other than any file of ours.
Json parseJson(std::string_view content, const std::string& file);

/// Text of a JSON value, on one line or indented. Bytes that are not UTF-8, which a file's name may hold, become
/// U+FFFD; dump() alone throws there, when all work is done.
template <class Value> std::string jsonText(const Value& json, int indent = -1) {
  return json.dump(indent, ' ', false, Value::error_handler_t::replace);
}

/// A value of a JSON file together with its place, so that each refusal is one sentence: file, dotted key, value,
/// what is allowed. Every reader throws Error.
class JsonPlace {
public:
  JsonPlace(const Json& value, std::string file, std::string key = {})
      : value_(&value), file_(std::move(file)), key_(std::move(key)) {}

  /// Refuses where this is not an object, lacks one of the keys or has another one.
  const JsonPlace& onlyKeys(const std::vector<std::string>& required,
                            const std::vector<std::string>& optional = {}) const;

  [[nodiscard]] JsonPlace at(const std::string& key) const;
  [[nodiscard]] bool has(const std::string& key) const { return value_->is_object() && value_->contains(key); }
  [[nodiscard]] bool isNull() const { return value_->is_null(); }
  [[nodiscard]] bool isString() const { return value_->is_string(); }
  [[nodiscard]] bool isNumber() const { return value_->is_number(); }
  /// A list whose first entry is a list.
  [[nodiscard]] bool isListOfLists() const {
    return value_->is_array() && !value_->empty() && value_->front().is_array();
  }

  [[nodiscard]] double number() const;
  [[nodiscard]] double number(double low, double high) const;
  [[nodiscard]] int integer() const;
  [[nodiscard]] int integer(int low, int high) const;
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] std::string string() const;
  [[nodiscard]] std::string asJson() const { return value_->dump(); } ///< whatever it is
  [[nodiscard]] std::vector<double> numbers() const;
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;
  [[nodiscard]] std::vector<JsonPlace> list() const;
  /// The value that a text names; `names` is a NamedEnum.
  template <class Names> [[nodiscard]] auto named(const Names& names) const {
    const auto value = names.find(string());
    if (!value) refuse(names.allowed());
    return *value;
  }

  /// Throws Error: file, key, value, and what is allowed.
  [[noreturn]] void refuse(const std::string& allowed) const;

private:
  const Json* value_;
  std::string file_;
  std::string key_;
};

/// The version under `key` of a file's format; refuses a newer one than `newest` with a sentence.
int formatVersion(const JsonPlace& root, const std::string& key, int newest);

} // namespace palp
