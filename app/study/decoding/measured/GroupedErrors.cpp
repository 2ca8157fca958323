#include "app/study/decoding/measured/GroupedErrors.h"

#include "app/study/decoding/Prediction.h"
#include "model/base/Cancelled.h"

#include <algorithm>

namespace palp {

namespace {

std::vector<Eigen::Index> allBut(const RowNumbers& leftOut, Eigen::Index count) {
  std::vector<Eigen::Index> stay;
  for (Eigen::Index i = 0; i < count; ++i)
    if (!std::binary_search(leftOut.begin(), leftOut.end(), i)) stay.push_back(i);
  return stay;
}

/// Forces, and below them places where the decoder gives them.
Eigen::MatrixXd answers(const Decoder& decoder, const SampleSet& samples) {
  PredictOptions bare;
  bare.standardDeviation = bare.area = false;
  const Prediction prediction = predict(decoder, inputsOf(samples, decoder.input), bare);
  Eigen::MatrixXd all(prediction.forces_N.rows() + prediction.places_mm.rows(), samples.size());
  all.topRows(prediction.forces_N.rows()) = prediction.forces_N;
  if (prediction.places_mm.rows() > 0) all.bottomRows(prediction.places_mm.rows()) = prediction.places_mm;
  return all;
}

} // namespace

MeasuredRows measuredRows(const SampleSet& samples, const Eigen::MatrixXd& inputs, const Eigen::MatrixXd& targets) {
  MeasuredRows rows{inputs.transpose(), targets.transpose(), {}, Eigen::VectorXi::Zero(samples.size())};
  if (samples.times_s.rows() > 0) rows.times_s = samples.times_s.row(0).transpose();
  for (Eigen::Index i = 1; samples.runs.rows() > 0 && i < samples.size(); ++i)
    rows.runs(i) = rows.runs(i - 1) + (samples.runs(0, i) != samples.runs(0, i - 1) ? 1 : 0);
  return rows;
}

GroupedErrors groupedErrors(const SampleSet& samples, const MeasuredRows& rows, const std::optional<RowOrder>& order,
                            const std::function<Decoder(const SampleSet&)>& train, const std::stop_token& stop,
                            const std::function<void(double)>& progress) {
  GroupedErrors found;
  found.dependence = findDependence(rows, order, stop);
  found.errors.resize(rows.targets.cols(), rows.size());
  const std::vector<Fold> folds = foldsFor(rows, found.dependence.order);
  for (std::size_t k = 0; k < folds.size(); ++k) {
    throwIfStopped(stop);
    progress(static_cast<double>(k) / static_cast<double>(folds.size()));
    const Fold& fold = folds[k];
    const Decoder decoder = train(samplesAt(samples, allBut(fold.leftOut, rows.size())));
    found.errors(Eigen::all, fold.judged) =
        rows.targets(fold.judged, Eigen::all).transpose() - answers(decoder, samplesAt(samples, fold.judged));
  }
  return found;
}

} // namespace palp
