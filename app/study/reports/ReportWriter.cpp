#include "app/study/reports/ReportWriter.h"

namespace palp {

ReportWriter::ReportWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop,
                           const std::string& texts, const std::vector<std::string>& csvHeads)
    : words_(texts), request_(request), progress_(std::move(progress)), stop_(std::move(stop)),
      row_(centreRowWire(request.design.rowWires())),
      range_N_(request.design.forceRange.high_N - request.design.forceRange.low_N), csv_(csvHeads) {
  content_.title = words_("title");
}

void ReportWriter::commonSection(const std::string& headingKey, const std::string& key) {
  add(ReportHeading{common_(headingKey)});
  add(ReportWords{common_(key)});
}

ReportContent ReportWriter::finished() {
  content_.csv = csv_.text();
  return std::move(content_);
}

std::string rowsText(int row) {
  return row < 0 ? "all" : std::to_string(row);
}

} // namespace palp
