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

/// How a report was made.
struct ReportRun {
  std::string command; ///< that makes it again
  int seeds = 1;
  std::uint64_t firstSeed = 1;
  double seconds = 0;
};

/// Every point of every curve: figure, mode, spread, area, force, errors, condition.
std::string protocolCsv(const ProtocolResult& result);

/// The page that compares the paper's numbers with ours.
std::string paperReportHtml(const ProtocolResult& result, const std::vector<ReportPicture>& pictures,
                            const ReportRun& run);

} // namespace palp
