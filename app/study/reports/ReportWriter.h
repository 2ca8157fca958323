#pragma once

#include "app/study/reports/Csv.h"
#include "app/study/reports/Report.h"
#include "app/study/reports/ReportText.h"

#include <stop_token>
#include <string>
#include <vector>

namespace palp {

/// What the writers of all reports share: request, progress, cancellation, texts, content and CSV.
class ReportWriter {
protected:
  /// The texts are those of resources/reports/`texts`.md; its "title" becomes the report's. `request` must outlive
  /// this.
  ReportWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop, const std::string& texts,
               const std::vector<std::string>& csvHeads);

  void progress(double share, const std::string& what) const {
    if (progress_) progress_(share, what);
  }
  void heading(const std::string& key, const ReportText::Values& values = {}) {
    content_.parts.emplace_back(ReportHeading{words_(key, values)});
  }
  void paragraph(const std::string& key, const ReportText::Values& values = {}) {
    content_.parts.emplace_back(ReportWords{words_(key, values)});
  }
  void add(ReportPart part) { content_.parts.push_back(std::move(part)); }
  /// A heading and a paragraph of the texts that reports share.
  void commonSection(const std::string& headingKey, const std::string& key);
  [[nodiscard]] ReportContent finished();

  const ReportText words_, common_{"common"};
  const ReportRequest& request_;
  const ReportProgress progress_;
  const std::stop_token stop_;
  const int row_;                 ///< the row-wire in the middle
  const Eigen::Vector3d range_N_; ///< of the forces
  ReportContent content_;
  Csv csv_;
};

/// "all" for -1.
std::string rowsText(int row);

} // namespace palp
