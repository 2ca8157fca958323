#include "nn/SpreadSweep.h"

#include "model/base/Cancelled.h"
#include "model/base/GotExpected.h"
#include "nn/NetworkError.h"

#include <cmath>
#include <string>

namespace palp {

std::vector<SweepRow> sweepSpreads(const SweepInput& input, const std::vector<double>& spreads,
                                   const RbfOptions& options, const std::function<void(std::size_t)>& progress,
                                   const std::stop_token& stop) {
  std::vector<SweepRow> rows;
  for (const double spread : spreads) {
    RbfOptions atSpread = options;
    atSpread.spread = spread;
    RbfFit fit;
    try {
      fit = trainRbf(input.samples, input.targets, atSpread, stop);
    } catch (const Cancelled&) {
      return rows;
    }
    SweepRow row;
    row.spread = spread;
    row.report = std::move(fit.report);
    row.predicted = fit.network.predict(input.testSamples);
    row.error = predictionError(row.predicted, input.testTargets, input.range);
    rows.push_back(std::move(row));
    if (progress) progress(rows.size());
  }
  return rows;
}

std::vector<double> logarithmicRange(double low, double high, int count) {
  if (!(low > 0 && low <= high && std::isfinite(high)))
    throw NetworkError("range: " + gotExpected(shortText(low) + " to " + shortText(high),
                                               "a first value above 0 and a last one not below it"));
  if (count < 1) throw NetworkError("values of the range: " + gotExpected(std::to_string(count), "1 or more"));
  std::vector<double> values;
  for (int i = 0; i < count; ++i)
    values.push_back(count == 1 ? low : i == count - 1 ? high : low * std::pow(high / low, i / (count - 1.0)));
  return values;
}

} // namespace palp
