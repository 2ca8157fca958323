#pragma once

#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportText.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace palp {

using Triples = std::vector<Eigen::Vector3d>; ///< of Fx, Fy, Fz, one for each set of samples

Eigen::Vector3d largest(const Triples& values);
/// Each triple divided by the other one of the same set.
Triples ratios(const Triples& above, const Triples& below);

/// Requirements and what several sets of samples gave, line by line. Good: every set meets the requirement. Doubtful:
/// their median does.
class RequirementTable {
public:
  /// The report's texts have "requirements table" and "summary"; the seeds of the sets count up from the first one. The
  /// CSV gets a line for each value.
  RequirementTable(const ReportText& words, Csv& csv, std::uint64_t firstSeed)
      : words_(words), csv_(csv), firstSeed_(firstSeed), table_(words.table("requirements table")) {}

  /// At most `required` in each force; infinite: for comparison only.
  void add(const std::string& what, const Eigen::Vector3d& required, const Triples& values, const std::string& note);
  /// One number for each set, at most `required`.
  void add(const std::string& what, double required, const std::vector<double>& values, const std::string& note);
  void addRow(std::initializer_list<ReportValue> cells, bool all, bool half);

  [[nodiscard]] const ReportTable& table() const { return table_; }
  [[nodiscard]] std::string summary() const;

private:
  const ReportText& words_;
  Csv& csv_;
  std::uint64_t firstSeed_;
  ReportTable table_;
};

} // namespace palp
