#pragma once

#include "app/study/reports/Report.h"
#include "io/StudyFile.h"

#include <filesystem>
#include <stop_token>

namespace palp {

/// The folder of a study: study.json (the complete plan), rows/ with a file for each finished design, and, once all
/// are, table.csv. A run that was killed continues where it ended; several may work on shards of one folder. Each row
/// has which program made it.
class StudyFolder {
public:
  /// Makes the folder. Throws Error where it cannot be that of the study.
  StudyFolder(std::filesystem::path folder, StudyPlan plan);
  /// Throws Error where the folder holds another study, or files of another kind.
  static void requireFits(const std::filesystem::path& folder, const StudyPlan& plan);

  [[nodiscard]] const StudyPlan& plan() const { return plan_; }
  [[nodiscard]] bool done(std::size_t design) const;
  /// Number of finished rows.
  [[nodiscard]] std::size_t rowsDone() const;

  /// Works out what is missing among the designs first..last-1, with `retryProblems` also those whose rows have a
  /// problem; `progress` gets the share of it that is done. False: stopped; what is done stays.
  bool compute(std::size_t first, std::size_t last, int threads, const ReportProgress& progress,
               const std::stop_token& stop, bool retryProblems = false);

  /// That rows are of several programs, or will be when this one continues: a sentence with their numbers. Else empty.
  [[nodiscard]] std::string mixedPrograms() const;

  /// Joins all rows, in the order of the designs, into table.csv. Throws Error where one is missing or broken.
  void writeTable() const;
  [[nodiscard]] std::filesystem::path table() const { return folder_ / "table.csv"; }
  [[nodiscard]] const std::filesystem::path& path() const { return folder_; }

private:
  [[nodiscard]] std::filesystem::path row(std::size_t design) const;
  /// Its line of the table. Throws Error where the row is broken.
  [[nodiscard]] std::string line(std::size_t design) const;
  [[nodiscard]] bool hasProblem(std::size_t design) const;

  std::filesystem::path folder_;
  StudyPlan plan_;
  int areas_;
  std::vector<std::string> columns_;
};

} // namespace palp
