#pragma once

// For sources only: includes io/StrictJson.h.

#include "io/StrictJson.h"
#include "model/base/NamedEnum.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace palp {

struct Indenter;
struct SensorDesign;
class JsonFields;

/// Limits of a number, both included.
struct Within {
  double low, high;
};

template <class Struct>
concept Described = requires(JsonFields& fields, Struct& value) {
  describe(fields, value);
};

// One value in a file: jsonOf() writes it, readJson() reads it and throws Error with file, key, value and the expected
// values. A last argument is the Within of a number or the NamedEnum of an enumeration.

inline Json jsonOf(const std::string& text) {
  return text;
}
inline void readJson(const JsonPlace& place, std::string& text) {
  text = place.string();
}

inline void readJson(const JsonPlace& place, bool& value) {
  value = place.boolean();
}
inline void readJson(const JsonPlace& place, double& value) {
  value = place.number();
}

/// Whole numbers are written without a decimal point, numbers that are not finite as null.
template <class Number>
requires std::is_arithmetic_v<Number> Json jsonOf(Number value, const Within& /*limits*/ = {}) {
  constexpr double kLargestWhole = 1e15;
  if constexpr (std::is_floating_point_v<Number>)
    if (value == std::floor(value) && std::abs(value) < kLargestWhole) return static_cast<std::int64_t>(value);
  return value;
}
template <class Number>
requires std::is_arithmetic_v<Number>
void readJson(const JsonPlace& place, Number& value, const Within& limits) {
  if constexpr (std::is_integral_v<Number>)
    value = static_cast<Number>(place.integer(static_cast<int>(limits.low), static_cast<int>(limits.high)));
  else
    value = place.number(limits.low, limits.high);
}

template <class Value, std::size_t Count> Json jsonOf(Value value, const NamedEnum<Value, Count>& names) {
  return names.name(value);
}
template <class Value, std::size_t Count>
void readJson(const JsonPlace& place, Value& value, const NamedEnum<Value, Count>& names) {
  value = place.named(names);
}

template <int Size> Json jsonOf(const Eigen::Vector<double, Size>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(jsonOf(value));
  return list;
}
template <int Size> void readJson(const JsonPlace& place, Eigen::Vector<double, Size>& values) {
  values = Eigen::Vector<double, Size>(place.numbers(Size).data());
}

template <class Number, std::size_t Size> Json jsonOf(const std::array<Number, Size>& values, const Within& = {}) {
  Json list = Json::array();
  for (const Number value : values) list.push_back(jsonOf(value));
  return list;
}
template <std::size_t Size> void readJson(const JsonPlace& place, std::array<double, Size>& values) {
  std::ranges::copy(place.numbers(Size), values.begin());
}
template <class Number, std::size_t Size>
void readJson(const JsonPlace& place, std::array<Number, Size>& values, const Within& limits) {
  const std::vector<JsonPlace> entries = place.list();
  if (entries.size() != Size) place.refuse("a list of " + std::to_string(Size) + " numbers");
  for (std::size_t k = 0; k < Size; ++k) readJson(entries[k], values[k], limits);
}

Json jsonOf(const SensorDesign& design);
void readJson(const JsonPlace& place, SensorDesign& design);
Json jsonOf(const Indenter& indenter);
void readJson(const JsonPlace& place, Indenter& indenter);

template <Described Struct> Json jsonOf(const Struct& value);
template <Described Struct> void readJson(const JsonPlace& place, Struct& value);

template <class Value> Json jsonOf(const std::vector<Value>& values) {
  Json list = Json::array();
  for (const Value& value : values) list.push_back(jsonOf(value));
  return list;
}
template <class Value> void readJson(const JsonPlace& place, std::vector<Value>& values) {
  for (const JsonPlace& entry : place.list()) readJson(entry, values.emplace_back());
}

/// The keys of a JSON object and the members of a struct that they store. A function describe(JsonFields&, Struct&)
/// calls one of field(), added(), ... for each key; the same description lists the keys, reads and writes.
class JsonFields {
public:
  struct Presence {
    bool listedAsRequired, mustBeRead, isWritten;
  };
  static constexpr Presence kAlways{true, true, true}, kAdded{false, false, true}, kBranch{false, true, true};

  [[nodiscard]] bool reading() const { return mode_ == Mode::Read; }

  /// A key that every file has.
  template <class Value, class... Form> void field(const std::string& key, Value& value, const Form&... form) {
    visit(key, kAlways, value, form...);
  }
  /// A key that is always written but that older files lack.
  template <class Value, class... Form> void added(const std::string& key, Value& value, const Form&... form) {
    visit(key, kAdded, value, form...);
  }
  /// A key that is absent where the value is `usual`, which `value` must be before reading.
  template <class Value, class... Form>
  void sparse(const std::string& key, Value& value, const std::type_identity_t<Value>& usual, const Form&... form) {
    visit(key, {false, false, !(value == usual)}, value, form...);
  }
  template <class Value, class... Form>
  void sparse(const std::string& key, std::optional<Value>& value, const Form&... form) {
    if (reading() && place_->has(key)) value.emplace();
    Value unset{};
    visit(key, {false, false, value.has_value()}, value ? *value : unset, form...);
  }
  /// Whether an object that has one of several forms has the one with `key`; `writes`: whether to write that form.
  /// The keys of a form are fields by branch().
  [[nodiscard]] bool form(const std::string& key, bool writes) const {
    return mode_ == Mode::List || (reading() ? place_->has(key) : writes);
  }
  template <class Value, class... Form> void branch(const std::string& key, Value& value, const Form&... form) {
    visit(key, kBranch, value, form...);
  }
  /// An object in the file whose keys are members of the same struct: `keys` is called with its fields.
  template <class Keys> void group(const std::string& key, bool required, const Keys& keys) {
    JsonFields inner(Mode::Write, nullptr);
    if (mode_ == Mode::Write) keys(inner);
    custom(
        key, {required, required, required || !inner.json_.empty()}, [&] { return inner.json_; },
        [&](const JsonPlace& place) { readWith(place, keys); });
  }
  /// A key whose value has functions of its own.
  template <class Write, class Read>
  void custom(const std::string& key, Presence presence, const Write& write, const Read& read) {
    if (mode_ == Mode::List) return list(key, presence.listedAsRequired);
    if (mode_ == Mode::Write) {
      if (presence.isWritten) json_[key] = write();
    } else if (presence.mustBeRead || place_->has(key)) {
      read(place_->at(key));
    }
  }

  /// Throws Error where a value that was read is not allowed.
  void require(const std::string& key, bool allowed, const std::string& expected) const {
    if (reading() && !allowed) place_->at(key).refuse(expected);
  }

  template <Described Struct> static Json written(Struct value) {
    JsonFields fields(Mode::Write, nullptr);
    describe(fields, value);
    return std::move(fields.json_);
  }
  template <Described Struct> static Struct read(const JsonPlace& place) {
    Struct value{}, unused{};
    readWith(place, [&](JsonFields& fields) { describe(fields, fields.reading() ? value : unused); });
    return value;
  }

private:
  enum class Mode { List, Read, Write };

  JsonFields(Mode mode, const JsonPlace* place) : mode_(mode), place_(place), json_(Json::object()) {}

  void list(const std::string& key, bool required) { (required ? required_ : optional_).push_back(key); }

  template <class Value, class... Form>
  void visit(const std::string& key, Presence presence, Value& value, const Form&... form) {
    custom(
        key, presence, [&] { return jsonOf(value, form...); },
        [&](const JsonPlace& place) { readJson(place, value, form...); });
  }

  template <class Keys> static void readWith(const JsonPlace& place, const Keys& keys) {
    JsonFields listed(Mode::List, nullptr), fields(Mode::Read, &place);
    keys(listed);
    place.onlyKeys(listed.required_, listed.optional_);
    keys(fields);
  }

  Mode mode_;
  const JsonPlace* place_;
  Json json_;
  std::vector<std::string> required_, optional_;
};

template <Described Struct> Json jsonOf(const Struct& value) {
  return JsonFields::written(value);
}
template <Described Struct> void readJson(const JsonPlace& place, Struct& value) {
  value = JsonFields::read<Struct>(place);
}

} // namespace palp
