#pragma once

#include "app/study/reports/Report.h"
#include "app/study/studies/StudyFolder.h"

namespace palp {

/// The finished study as a page: the best designs by each quantity, and each quantity over each number that varies.
ReportContent studyReport(const StudyFolder& study);

} // namespace palp
