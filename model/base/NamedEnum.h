#pragma once

#include "model/base/Error.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace palp {

/// The values of an enumeration and their names in files and on the command line: one table for both directions and
/// for the list of what is allowed.
///   constexpr NamedEnum kModes("mode", std::array{std::pair{Mode::A, "a"}, std::pair{Mode::B, "b"}});
template <class Value, std::size_t Count> class NamedEnum {
public:
  /// `what` is what refusals call the enumeration.
  constexpr NamedEnum(const char* what, const std::array<std::pair<Value, const char*>, Count>& names)
      : what_(what), names_(names) {}

  /// Empty for a value that has no name.
  [[nodiscard]] std::string name(Value value) const {
    for (const auto& [known, text] : names_)
      if (known == value) return text;
    return {};
  }
  [[nodiscard]] std::optional<Value> find(std::string_view name) const {
    for (const auto& [value, known] : names_)
      if (name == known) return value;
    return {};
  }
  /// Throws Error with the names that are allowed.
  [[nodiscard]] Value value(const std::string& name) const {
    if (const auto found = find(name)) return *found;
    throw Error(std::string(what_) + ": got '" + name + "', expected " + allowed());
  }
  /// "a, b or c".
  [[nodiscard]] std::string allowed() const {
    std::string list;
    for (std::size_t i = 0; i < Count; ++i)
      list += (i == 0 ? "" : i + 1 == Count ? " or " : ", ") + std::string(names_[i].second);
    return list;
  }
  [[nodiscard]] const auto& all() const { return names_; }

private:
  const char* what_;
  std::array<std::pair<Value, const char*>, Count> names_;
};

} // namespace palp
