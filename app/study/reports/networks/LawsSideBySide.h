#pragma once

#include "app/study/reports/Report.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/layout/SignalComparison.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace palp {

/// A law with a read-out: its resistances at rest, their answer to the forces, and its bounds.
struct LawReading {
  std::string name; ///< Eq. (1), or that of the read-out
  Eigen::MatrixXd rest_ohm;
  LogSensitivity slopes; ///< d ln R / dF
  std::function<LayoutBound(int rowWire, double noise)> bound;
};

/// A design read by Eq. (1) and by each read-out of the field, all linear and at rest.
class LawsSideBySide {
public:
  /// `law`: of the field, whatever the design's own is; `response` (AreaResponse::atRest) outlives this. Throws as
  /// FieldResponse does.
  LawsSideBySide(const SensorDesign& design, const FieldLaw& law, const AreaResponse& response, int threads,
                 StageLog& stages, const std::stop_token& stop);

  /// Eq. (1) first.
  [[nodiscard]] const std::vector<LawReading>& readings() const { return readings_; }
  /// Resistances and signals compared with Eq. (1).
  [[nodiscard]] ReportTable signals() const;
  /// With and without prior, of the row-wire in the middle and of all; `figures` gets them by name.
  [[nodiscard]] ReportTable bounds(double noise, std::vector<std::pair<std::string, double>>* figures) const;

private:
  int row_;
  std::shared_ptr<const FieldResponse> field_;
  std::vector<LawReading> readings_;
};

} // namespace palp
