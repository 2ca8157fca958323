#pragma once

#include "app/study/reports/Report.h"
#include "io/StudyFile.h"

#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// Most areas that any of the designs has that can be; the rows of the others say why not.
int studyAreas(const StudyPlan& plan);

/// The columns of the table of a study with `areas` areas: number of the design, the keys that vary, why it has no
/// result ("problem"), and what is computed, with units.
std::vector<std::string> studyColumns(const StudyPlan& plan, int areas);

/// The results of a study for one design. The same bytes at any number of threads.
struct StudyRow {
  std::string problem;                         ///< a sentence; then there are no values
  std::vector<std::optional<double>> values{}; ///< one for each computed column; none: it does not apply
};

/// Returns nullopt if cancelled.
std::optional<StudyRow> studyRow(const StudyPlan& plan, std::size_t design, int areas, int threads,
                                 const ReportProgress& progress, const std::stop_token& stop);

/// The row as a line of CSV.
std::string studyLine(const StudyPlan& plan, const std::vector<std::string>& columns, std::size_t design,
                      const StudyRow& row);

} // namespace palp
