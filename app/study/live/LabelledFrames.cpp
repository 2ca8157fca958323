#include "app/study/live/LabelledFrames.h"

#include "io/SampleFile.h"
#include "model/base/Error.h"
#include "model/base/NumberText.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace palp {

namespace {

constexpr double kHiddenDeviations = 5;    // a load within that many of them may hide in the noise
constexpr double kLeastShare = 0.1;        // of the label, or of what is read: less than any gain would make of it
constexpr double kFarShare = 3;            // of one to the other: rarely is a sensor so far from its model
constexpr double kMostOffset_range = 0.05; // that may exist at rest for calibration to remove

template <class Matrix> Matrix withoutColumn(const Matrix& all, Eigen::Index column) {
  Matrix rest(all.rows(), all.cols() - 1);
  rest.leftCols(column) = all.leftCols(column);
  rest.rightCols(all.cols() - column - 1) = all.rightCols(all.cols() - column - 1);
  return rest;
}

} // namespace

std::string inNewton(const Eigen::Vector3d& force_N) {
  const Eigen::Array3d shown = force_N.array() + 0.0; // no -0
  return "(" + withDecimals(shown.x(), 2) + ", " + withDecimals(shown.y(), 2) + ", " + withDecimals(shown.z(), 2) +
         ") N";
}

std::string labelAgainstReading(const Eigen::Vector3d& label_N, const DecodedForces& reads, int area,
                                const Decoder& decoder) {
  if (!reads.valid || reads.forces_N.cols() == 0) return {};
  const Eigen::Index column = std::min<Eigen::Index>(area, reads.forces_N.cols() - 1);
  const Eigen::Vector3d read_N = reads.forces_N.col(column);
  const double deviation_N = reads.standardDeviation_N.col(column).maxCoeff();
  const double hidden_N = kHiddenDeviations * deviation_N;
  const double offset_N = kMostOffset_range * (decoder.high_N - decoder.low_N).maxCoeff();
  const std::string both = "the label has " + inNewton(label_N) + ", but the network predicts " + inNewton(read_N);
  if (label_N.norm() > hidden_N && read_N.norm() < std::max(hidden_N, kLeastShare * label_N.norm()))
    return both + ", as at rest; check that the load is on the sensor";
  if (label_N.norm() < kLeastShare * read_N.norm() && read_N.norm() > std::max(hidden_N, offset_N))
    return both + "; check that the sensor is at rest";
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (label_N(axis) * read_N(axis) < 0 &&
        std::min(std::abs(label_N(axis)), std::abs(read_N(axis))) > std::max(hidden_N, offset_N))
      return both + ", with the other sign of F" + "xyz"[axis] + "; check the label's sign (a push is negative in z)";
  const double less_N = std::min(label_N.norm(), read_N.norm()), more_N = std::max(label_N.norm(), read_N.norm());
  if (more_N > kFarShare * less_N && more_N - less_N > std::max(hidden_N, offset_N))
    return both + "; check that this load is on the sensor";
  return {};
}

void LabelledFrames::begin(const Decoder& decoder, const SensorDesign& design, const KnownTouch& label, int frames) {
  if (const auto wrong = whyInvalid(LoadCase{{label.load}, {}}, design)) throw Error("label: " + *wrong);
  average_.emplace(decoder, design, label);
  wanted_ = frames;
}

bool LabelledFrames::add(const DecodedForces& forces) {
  if (!average_) return false;
  average_->add(forces);
  if (average_->count() < wanted_) return false;
  const FrameAverage done = *std::exchange(average_, std::nullopt);
  if (const std::string moved = done.moved(); !moved.empty())
    throw Error("the load moved while it was averaged (" + moved + "); hold it still and collect again");
  append(done.sample(), "the board");
  predicted_N_.rightCols<1>() = done.predicted_N();
  doubt_ = done.onAnotherArea();
  return true;
}

void LabelledFrames::append(const SampleSet& frames, const std::string& from) {
  if (samples_.size() > 0)
    if (const std::string differs = differenceOfHeads(samples_, frames); !differs.empty())
      throw Error(from + ": differs from the frames already collected: " + differs);
  palp::append(samples_, frames);
  const Eigen::Index before = predicted_N_.cols();
  predicted_N_.conservativeResize(3, samples_.size());
  predicted_N_.rightCols(samples_.size() - before).setConstant(std::numeric_limits<double>::quiet_NaN());
}

void LabelledFrames::clear() {
  samples_ = {};
  predicted_N_.resize(3, 0);
}

void LabelledFrames::replace(const SampleSet& samples, const Eigen::Matrix3Xd& predicted_N) {
  samples_ = samples;
  predicted_N_ = predicted_N;
}

void LabelledFrames::remove(Eigen::Index sample) {
  if (sample < 0 || sample >= samples_.size()) return;
  if (samples_.size() == 1) return clear();
  Eigen::VectorXi area(samples_.size() - 1);
  area.head(sample) = samples_.area.head(sample);
  area.tail(area.size() - sample) = samples_.area.tail(area.size() - sample);
  samples_.area = area;
  for (const auto part : kSampleParts)
    if ((samples_.*part).rows() > 0) samples_.*part = withoutColumn(samples_.*part, sample);
  predicted_N_ = withoutColumn(predicted_N_, sample);
}

void LabelledFrames::load(const std::filesystem::path& path) {
  append(loadSamples(path), path.string());
}

void LabelledFrames::save(const std::filesystem::path& path) const {
  saveSamples(path, samples_, true);
}

} // namespace palp
