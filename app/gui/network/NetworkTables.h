#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QStringList>

#include <vector>

namespace palp {

/// A table as heads and rows of text.
struct TableText {
  QStringList heads;
  std::vector<QStringList> rows;
};

/// A sweep, one spread a row.
TableText sweepTable(const std::vector<SweepPoint>& points);
/// The comparison, one decoder a row.
TableText trialsTable(const std::vector<DecoderTrial>& trials);
/// The spread of the smallest error (root mean square, as `palp sweep` chooses); none without points.
std::optional<double> bestSpread(const std::vector<SweepPoint>& points);

} // namespace palp
