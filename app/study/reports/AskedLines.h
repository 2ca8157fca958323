#pragma once

#include "app/study/reports/Csv.h"
#include "app/study/reports/Report.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace palp {

using Triples = std::vector<Eigen::Vector3d>; ///< of Fx, Fy, Fz, one a set of samples

Eigen::Vector3d largest(const Triples& values);
/// Each triple over the other one of the same set.
Triples ratios(const Triples& above, const Triples& below);

/// What is asked against what several sets of samples gave, line by line. Good: every set keeps it. Doubtful: their
/// median does.
class AskedLines {
public:
  /// Seeds of the sets count up from the first one.
  explicit AskedLines(std::uint64_t firstSeed) : firstSeed_(firstSeed) {}

  /// At most `asked` in each force.
  void add(const std::string& what, const Eigen::Vector3d& asked, const Triples& values, const std::string& beside);
  /// One number a set, at most `asked`.
  void add(const std::string& what, double asked, const std::vector<double>& values, const std::string& beside);
  void addRow(std::vector<std::string> cells, bool all, bool half);

  [[nodiscard]] const ReportTable& table() const { return table_; }
  [[nodiscard]] const std::string& csv() const { return csv_.text(); }
  [[nodiscard]] std::string summary() const;

private:
  std::uint64_t firstSeed_;
  ReportTable table_{
      "Fx / Fy / Fz", {"requirement", "largest error", "median of the sets", "worst set", "note"}, {}, {}};
  Csv csv_{{"what", "seed", "force", "value", "asked"}};
};

} // namespace palp
