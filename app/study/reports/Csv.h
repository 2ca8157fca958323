#pragma once

#include <Eigen/Core>

#include <initializer_list>
#include <string>
#include <vector>

namespace palp {

/// A cell of a CSV: text, or a number that reads back as the same number; empty where it does not apply.
class CsvCell {
public:
  CsvCell(const char* words);        // NOLINT(google-explicit-constructor): cells are written in place
  CsvCell(const std::string& words); // NOLINT(google-explicit-constructor)
  CsvCell(double number);            // NOLINT(google-explicit-constructor)
  CsvCell(int number);               // NOLINT(google-explicit-constructor)

  [[nodiscard]] const std::string& text() const { return text_; }

private:
  std::string text_;
};

/// A quantity of each force by its name.
struct CsvForces {
  std::string what;
  Eigen::Vector3d values; ///< of Fx, Fy, Fz
};

/// Comma-separated values with one header line; fields with commas or quotes are quoted (RFC 4180).
class Csv {
public:
  explicit Csv(const std::vector<std::string>& heads);
  /// One line; as many cells as heads.
  void add(std::initializer_list<CsvCell> cells);
  void add(const std::vector<CsvCell>& cells);
  /// For Fx, Fy and Fz a line of each quantity: its name, `cells`, the force, `after`, its value.
  void addForces(const std::vector<CsvForces>& quantities, const std::vector<CsvCell>& cells,
                 const std::vector<CsvCell>& after = {});
  [[nodiscard]] const std::string& text() const { return text_; }

private:
  std::size_t columns_;
  std::string text_;
};

} // namespace palp
