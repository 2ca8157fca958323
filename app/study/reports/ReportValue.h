#pragma once

#include <Eigen/Core>

#include <concepts>
#include <string>
#include <utility>

namespace palp {

/// Four significant digits, or "-" for what is not finite.
std::string shortNumber(double value);
/// x / y / z in short.
std::string triple(const Eigen::Vector3d& values);

/// A value as a report prints it: text as it is, whole numbers in full, other numbers and triples in short.
class ReportValue {
public:
  // Not explicit: cells of tables and values of texts are written in place.
  ReportValue(std::string text = {}) : text_(std::move(text)) {}            // NOLINT(google-explicit-constructor)
  ReportValue(const char* text) : text_(text) {}                            // NOLINT(google-explicit-constructor)
  ReportValue(double number) : text_(shortNumber(number)) {}                // NOLINT(google-explicit-constructor)
  ReportValue(std::integral auto number) : text_(std::to_string(number)) {} // NOLINT(google-explicit-constructor)
  template <class Derived>
  ReportValue(const Eigen::MatrixBase<Derived>& forces)
      : text_(triple(forces)) {} // NOLINT(google-explicit-constructor)

  [[nodiscard]] const std::string& text() const { return text_; }

private:
  std::string text_;
};

} // namespace palp
