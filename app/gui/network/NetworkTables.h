#pragma once

#include "app/gui/jobs/NetworkSession.h"
#include "app/study/decoding/NoiseBound.h"

#include <QStringList>

#include <vector>

namespace palp {

/// A table as heads and rows of text.
struct TableText {
  QStringList heads;
  std::vector<QStringList> rows;
};

/// A sweep, one spread a row; "-" of forces that are 0 in the samples (null: not known).
TableText sweepTable(const std::vector<SweepPoint>& points, const NetworkSamples* samples);
/// The comparison, one decoder a row, and below them the bound with prior; null: not known.
TableText trialsTable(const std::vector<DecoderTrial>& trials, const NoiseBound* bound, const NetworkSamples* samples);
/// Trained networks with their errors and settings, one a row.
TableText networksTable(const std::vector<std::shared_ptr<const NetworkFit>>& networks);
/// The decoder of the smallest error of the force (root mean square); none where none was trained.
std::optional<std::size_t> bestTrial(const std::vector<DecoderTrial>& trials);
/// That of the smallest error of the place (median); none where none learned places.
std::optional<std::size_t> bestPlace(const std::vector<DecoderTrial>& trials);
/// The point of the smallest error (root mean square, as `palp sweep` chooses); none without points.
std::optional<std::size_t> bestPoint(const std::vector<SweepPoint>& points);

} // namespace palp
