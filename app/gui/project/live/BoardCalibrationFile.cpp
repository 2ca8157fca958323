#include "app/gui/project/live/BoardCalibrationFile.h"

#include "app/gui/project/live/BoardCalibration.h"
#include "io/DecoderFile.h"
#include "io/SampleText.h"
#include "model/base/Error.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QString>

#include <limits>
#include <memory>
#include <utility>

namespace palp {

namespace {

constexpr const char* kFramesKey = "frames";
constexpr const char* kReadingsKey = "network_read_N";
constexpr const char* kCalibratedKey = "network";
constexpr const char* kCalibratedNameKey = "name";

/// The lines of a sample file.
QJsonArray frameLines(const SampleSet& samples) {
  QJsonArray lines;
  for (const QString& line : QString::fromStdString(samplesText(samples)).split('\n', Qt::SkipEmptyParts))
    lines.append(line);
  return lines;
}

QJsonArray frameReadingsJson(const Eigen::Matrix3Xd& read_N) {
  QJsonArray all;
  for (Eigen::Index frame = 0; frame < read_N.cols(); ++frame) {
    const auto force_N = read_N.col(frame);
    all.append(force_N.allFinite() ? QJsonValue(QJsonArray{force_N(0), force_N(1), force_N(2)}) : QJsonValue());
  }
  return all;
}

SampleSet labelledSamplesOf(const JsonPlace& place) {
  std::string text;
  for (const JsonPlace& line : place.list()) text += line.string() + "\n";
  try {
    return parseSamples(text, kFramesKey);
  } catch (const Error& error) {
    place.refuse(std::string("the lines of a sample file (") + error.what() + ")");
  }
}

Eigen::Matrix3Xd frameReadingsOf(const JsonPlace& place, Eigen::Index frames) {
  const std::vector<JsonPlace> entries = place.list();
  if (static_cast<Eigen::Index>(entries.size()) != frames)
    place.refuse("three forces or null for each of the " + std::to_string(frames) + " frames");
  Eigen::Matrix3Xd read_N = Eigen::Matrix3Xd::Constant(3, frames, std::numeric_limits<double>::quiet_NaN());
  for (Eigen::Index frame = 0; frame < frames; ++frame) {
    const JsonPlace& entry = entries[static_cast<std::size_t>(frame)];
    if (!entry.isNull()) read_N.col(frame) = Eigen::Vector3d(entry.numbers(3).data());
  }
  return read_N;
}

Decoder calibratedDecoderOf(const JsonPlace& place) {
  try {
    return parseNetwork(place.asJson(), kCalibratedKey);
  } catch (const Error& error) {
    place.refuse(std::string("a network of Palp (") + error.what() + ")");
  }
}

} // namespace

QJsonObject calibrationJson(const LiveSettings& live) {
  QJsonObject json;
  if (live.frames) {
    json[kFramesKey] = frameLines(live.frames->samples);
    json[kReadingsKey] = frameReadingsJson(live.frames->read_N);
  }
  if (live.calibrated) {
    json[kCalibratedKey] =
        QJsonDocument::fromJson(QByteArray::fromStdString(networkText(live.calibrated->decoder))).object();
    json[kCalibratedNameKey] = QString::fromStdString(live.calibrated->name);
  }
  return json;
}

void readCalibration(const JsonPlace& place, LiveSettings& live) {
  place.onlyKeys({}, {kFramesKey, kReadingsKey, kCalibratedKey, kCalibratedNameKey});
  if (place.has(kFramesKey)) {
    SampleSet samples = labelledSamplesOf(place.at(kFramesKey));
    Eigen::Matrix3Xd read_N = frameReadingsOf(place.at(kReadingsKey), samples.size());
    live.frames = std::make_shared<const BoardFrames>(BoardFrames{std::move(samples), std::move(read_N)});
  }
  if (place.has(kCalibratedKey))
    live.calibrated = std::make_shared<const CalibratedNetwork>(
        CalibratedNetwork{calibratedDecoderOf(place.at(kCalibratedKey)), place.at(kCalibratedNameKey).string()});
}

} // namespace palp
