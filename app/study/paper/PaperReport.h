#pragma once

#include "app/study/paper/PaperProtocol.h"

#include <filesystem>
#include <string>
#include <vector>

namespace palp {

/// A picture file of a report.
struct ReportPicture {
  std::filesystem::path png;
  std::string caption;
  std::string section; ///< deformation, table1 or fig12
};

/// What a report says about how it came about.
struct ReportRun {
  std::string command; ///< that makes it again
  int seeds = 1;
  std::uint64_t firstSeed = 1;
  double seconds = 0;
};

/// Every point of every curve: figure, mode, spread, area, force, errors, condition.
std::string protocolCsv(const ProtocolResult& result);

/// The page with the paper's numbers beside ours.
std::string paperReportHtml(const ProtocolResult& result, const std::vector<ReportPicture>& pictures,
                            const ReportRun& run);

/// Machine and versions, for the foot of a report.
std::string machineLine();

} // namespace palp
