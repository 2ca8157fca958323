#include "app/study/decoding/measured/MeasuredWords.h"

#include "model/base/GotExpected.h"
#include "model/base/NumberText.h"

#include <cmath>

namespace palp {

namespace {

constexpr double kLikeTheMean = 0.9;     ///< error, of the forces' deviations
constexpr double kClearlyMore = 1.3;     ///< of another number
constexpr double kRepeated = 0.95;       ///< share of leaders below which rows count as repeated
constexpr double kTooMuchOutside = 0.02; ///< share of frames

/// "Fx 0.12, Fz 0.24 N (4.3, 6.0 % of range)": those that vary.
std::string errorsText(const Decoder& decoder, const Eigen::VectorXd& errors) {
  std::string values, percents;
  for (Eigen::Index i = 0; i < decoder.outputs() && i < errors.size(); ++i) {
    const double range_N = decoder.high_N(i) - decoder.low_N(i);
    if (!(range_N > 0)) continue;
    values += (values.empty() ? "F" : ", F") + std::string(1, "xyz"[i % 3]) + " " + withDigits(errors(i), 2);
    percents += (percents.empty() ? "" : ", ") + withDigits(100 * errors(i) / range_N, 2);
  }
  std::string text = values.empty() ? "" : values + " N (" + percents + " % of range)";
  if (decoder.place && errors.size() >= decoder.outputs() + 2)
    text += (text.empty() ? "x " : ", x ") + withDigits(errors(decoder.outputs()), 2) + ", y " +
            withDigits(errors(decoder.outputs() + 1), 2) + " mm";
  return text;
}

} // namespace

std::string leftOutInWords(const RowDependence& found, std::size_t samples) {
  const std::string correlation = withDigits(found.correlation, 2);
  if (found.order == RowOrder::Runs) return "complete runs are left out in turn";
  if (found.order == RowOrder::Time)
    return "rows depend on their neighbours (correlation of a line's errors " + correlation +
           "): five stretches of the table are left out in turn, with " + std::to_string(samples / 40) +
           " rows on both sides";
  if (found.leaders < kRepeated)
    return "rows repeat: " + withDigits(100 * found.leaders, 2) +
           " % of them differ from all before; rows that are nearly equal are left out together";
  return "rows are independent of their neighbours (correlation of a line's errors " + correlation +
         "): rows are left out at random";
}

namespace {

std::string taken(const Decoder& decoder) {
  const MeasuredTraining& measured = *decoder.measured;
  std::string text = decoder.report.centers > 0 ? std::to_string(decoder.report.centers) + " Gaussians of spread " +
                                                      withDigits(decoder.report.spread, 3)
                                                : std::string("a line");
  text += ", ridge " + withDigits(decoder.report.ridge, 2);
  if (measured.stage.transform == ReadingTransform::Logarithm) text += ", of the readings' logarithms";
  if (measured.stage.transform == ReadingTransform::Inverse) text += ", of 1/reading";
  if (!measured.stage.hasMemory()) return text + ", no memory";
  text += ", memory of ";
  for (std::size_t i = 0; i < measured.stage.times_s.size(); ++i)
    text += (i == 0 ? "" : ", ") + withDigits(measured.stage.times_s[i], 2);
  return text + (measured.stage.rowsAreClock ? " rows" : " s");
}

} // namespace

std::vector<std::string> measuredSentences(const Decoder& decoder, std::size_t samples, bool hasClock) {
  if (!decoder.measured) return {};
  const MeasuredTraining& measured = *decoder.measured;
  std::vector<std::string> all{leftOutInWords(measured.dependence, samples), "taken: " + taken(decoder)};
  std::string error = "error on later rows: " + errorsText(decoder, measured.stated);
  if (measured.stated.norm() > kClearlyMore * measured.singleRows.norm())
    error += "; single rows left out would have stated " + errorsText(decoder, measured.singleRows) +
             ": neighbours are copies";
  all.push_back(error);
  if (measured.relativeRecording)
    all.push_back("error with a complete recording left out: " + errorsText(decoder, *measured.recording) +
                  "; expect this on another day");
  if (measured.dependence.order != RowOrder::Independent && !hasClock && !measured.stage.hasMemory())
    all.emplace_back(
        "without a column of time no memory was tried; --clock rows if the rows are equally spaced in time");
  return all;
}

std::string keptBackInWords(const Decoder& decoder, const Prediction& prediction, const SampleSet& kept) {
  Eigen::MatrixXd errors(decoder.answers(), kept.size()), deviations(decoder.answers(), kept.size());
  errors.topRows(decoder.outputs()) = prediction.forces_N - kept.forces_N;
  deviations.topRows(decoder.outputs()) = prediction.standardDeviation_N;
  if (decoder.place) {
    errors.bottomRows<2>() = prediction.places_mm - kept.touchedPlaces_mm();
    deviations.bottomRows<2>() = prediction.placeDeviation_mm;
  }
  std::string text = "error on the " + std::to_string(kept.size()) +
                     " samples kept back: " + errorsText(decoder, errors.array().square().rowwise().mean().sqrt());
  double within = 0, counted = 0;
  for (Eigen::Index i = 0; i < errors.rows(); ++i) {
    if (i < decoder.outputs() && !(decoder.high_N(i) > decoder.low_N(i))) continue; // not measured
    within += (errors.row(i).array().abs() <= deviations.row(i).array()).cast<double>().mean();
    ++counted;
  }
  within /= counted;
  return text + "; " + withDigits(100 * within, 2) + " % of the errors within one stated deviation (68 expected)";
}

std::vector<std::string> measuredWarnings(const Decoder& decoder) {
  if (!decoder.measured) return {};
  const MeasuredTraining& measured = *decoder.measured;
  std::vector<std::string> all;
  if (measured.relative > kLikeTheMean)
    all.push_back("the decoder is hardly better than predicting the mean force: its error is " +
                  withDigits(measured.relative, 2) + " of the forces' deviation");
  if (measured.relativeRecording && *measured.relativeRecording > kClearlyMore * measured.relative)
    all.push_back("another recording errs more: " + withDigits(*measured.relativeRecording, 2) +
                  " of the forces' deviation instead of " + withDigits(measured.relative, 2));
  return all;
}

std::string outsideWarning(const std::vector<bool>& outside) {
  std::size_t count = 0;
  for (const bool one : outside) count += one ? 1 : 0;
  if (static_cast<double>(count) <= kTooMuchOutside * static_cast<double>(outside.size())) return {};
  return std::to_string(count) + " of " + std::to_string(outside.size()) +
         " samples are outside what was trained: no error is known for them";
}

} // namespace palp
