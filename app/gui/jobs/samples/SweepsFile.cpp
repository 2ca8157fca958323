#include "app/gui/jobs/samples/SweepsFile.h"

#include "app/gui/project/ProjectFile.h"
#include "io/StrictJson.h"
#include "model/base/Error.h"

#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <algorithm>
#include <cmath>
#include <limits>

namespace palp {

namespace {

constexpr const char* kVersionKey = "palp_sweeps";
constexpr int kVersion = 1;
constexpr std::size_t kMostOutputs = 8; ///< of a decoder: forces and a place
constexpr double kLargest = 1e300;

QJsonValue json(double value) {
  return std::isfinite(value) ? QJsonValue(value) : QJsonValue();
}

QJsonArray json(const Eigen::VectorXd& values) {
  QJsonArray all;
  for (const double value : values) all.append(json(value));
  return all;
}

double numberOf(const JsonPlace& place) {
  return place.isNull() ? std::numeric_limits<double>::infinity() : place.number(-kLargest, kLargest);
}

Eigen::VectorXd numbersOf(const JsonPlace& place) {
  const std::vector<JsonPlace> entries = place.list();
  if (entries.size() > kMostOutputs) place.refuse("a list of at most " + std::to_string(kMostOutputs) + " numbers");
  Eigen::VectorXd values(static_cast<Eigen::Index>(entries.size()));
  for (std::size_t k = 0; k < entries.size(); ++k) values(static_cast<Eigen::Index>(k)) = numberOf(entries[k]);
  return values;
}

QJsonObject errorJson(const PredictionError& error) {
  return {{"eq13_percent", json(error.eq13Percent)},
          {"eq13_floored_percent", json(error.eq13FlooredPercent)},
          {"mean_absolute", json(error.meanAbsolute)},
          {"rmse_percent_of_range", json(error.rmsePercentOfRange)}};
}

PredictionError errorOf(const JsonPlace& place) {
  place.onlyKeys({"eq13_percent", "eq13_floored_percent", "mean_absolute", "rmse_percent_of_range"});
  PredictionError error; // its floor is not in the file: no sweep or comparison shows it
  error.eq13Percent = numbersOf(place.at("eq13_percent"));
  error.eq13FlooredPercent = numbersOf(place.at("eq13_floored_percent"));
  error.meanAbsolute = numbersOf(place.at("mean_absolute"));
  error.rmsePercentOfRange = numbersOf(place.at("rmse_percent_of_range"));
  return error;
}

QJsonObject settingsJson(const NetworkSettings& settings) {
  return QJsonDocument::fromJson(networkText(settings)).object();
}

NetworkSettings settingsOf(const JsonPlace& place, const QString& file) {
  return parseNetwork(QByteArray::fromStdString(place.asJson()), file);
}

QJsonObject pointJson(const SweepPoint& point) {
  return {{"spread", point.spread},
          {"error", errorJson(point.error)},
          {"leave_one_out_N", json(point.report.leaveOneOut)},
          {"condition", json(point.report.condition)},
          {"ridge", point.report.ridge},
          {"centers", point.report.centers},
          {"seconds", point.report.seconds}};
}

SweepPoint pointOf(const JsonPlace& place) {
  place.onlyKeys({"spread", "error", "leave_one_out_N", "condition", "ridge", "centers", "seconds"});
  SweepPoint point;
  point.spread = point.report.spread = place.at("spread").number(0, kLargest);
  point.error = errorOf(place.at("error"));
  point.report.leaveOneOut = numbersOf(place.at("leave_one_out_N"));
  point.report.condition = numberOf(place.at("condition"));
  point.report.ridge = place.at("ridge").number(0, kLargest);
  point.report.centers = place.at("centers").integer(0, std::numeric_limits<int>::max());
  point.report.seconds = place.at("seconds").number(0, kLargest);
  return point;
}

QJsonObject trialJson(const DecoderTrial& trial) {
  QJsonObject object{{"decoder", QString::fromStdString(name(trial.kind))},
                     {"error", errorJson(trial.error)},
                     {"spread", trial.spread},
                     {"seconds", trial.seconds},
                     {"microseconds_per_sample", trial.microsecondsPerSample},
                     {"not_trained_because", trial.refusal}};
  if (trial.place)
    object["place_mm"] =
        QJsonArray{json(trial.place->median_mm), json(trial.place->rms_mm.x()), json(trial.place->rms_mm.y())};
  return object;
}

DecoderTrial trialOf(const JsonPlace& place) {
  place.onlyKeys({"decoder", "error", "spread", "seconds", "microseconds_per_sample", "not_trained_because"},
                 {"place_mm"});
  DecoderTrial trial;
  trial.kind = place.at("decoder").named(kDecoderKinds);
  trial.error = errorOf(place.at("error"));
  if (place.has("place_mm")) {
    const std::vector<double> numbers = place.at("place_mm").numbers(3);
    trial.place = PlaceError{{numbers[1], numbers[2]}, numbers[0], {}};
  }
  trial.spread = place.at("spread").number(0, kLargest);
  trial.seconds = place.at("seconds").number(0, kLargest);
  trial.microsecondsPerSample = place.at("microseconds_per_sample").number(0, kLargest);
  trial.refusal = QString::fromStdString(place.at("not_trained_because").string());
  return trial;
}

/// Which samples they are of, as far as a file of samples says it.
QJsonObject samplesJson(const NetworkSamples& samples) {
  return {{"design", QString::fromStdString(samples.training.origin.designFingerprint)},
          {"training", static_cast<qint64>(samples.training.size())},
          {"test", static_cast<qint64>(samples.test.size())},
          {"seed", QString::number(samples.training.origin.seed)}};
}

} // namespace

QByteArray sweepsText(const NetworkResults& results) {
  QJsonObject root{{kVersionKey, kVersion}, {"samples", samplesJson(*results.samples)}};
  if (!results.sweep.empty()) {
    QJsonArray points;
    for (const SweepPoint& point : results.sweep) points.append(pointJson(point));
    root["sweep"] = QJsonObject{{"settings", settingsJson(results.sweepSettings)}, {"points", points}};
  }
  if (!results.trials.empty()) {
    QJsonArray trials;
    for (const DecoderTrial& trial : results.trials) trials.append(trialJson(trial));
    root["comparison"] = QJsonObject{{"settings", settingsJson(results.trialsSettings)}, {"decoders", trials}};
  }
  return QJsonDocument(root).toJson();
}

void parseSweeps(const QByteArray& text, const QString& file, NetworkResults& results) {
  const std::string name = file.toStdString();
  const Json json = parseJson({text.data(), static_cast<std::size_t>(text.size())}, name);
  const JsonPlace root(json, name);
  root.onlyKeys({kVersionKey, "samples"}, {"sweep", "comparison"});
  formatVersion(root, kVersionKey, kVersion);
  const QByteArray of = QByteArray::fromStdString(root.at("samples").asJson());
  if (QJsonDocument::fromJson(of).object() != samplesJson(*results.samples))
    throw Error(name + ": its sweep and comparison belong to other samples than the project's; they are not shown");
  NetworkResults found;
  if (root.has("sweep")) {
    const JsonPlace place = root.at("sweep");
    found.sweepSettings = settingsOf(place.onlyKeys({"settings", "points"}).at("settings"), file);
    for (const JsonPlace& point : place.at("points").list()) found.sweep.push_back(pointOf(point));
  }
  if (root.has("comparison")) {
    const JsonPlace place = root.at("comparison");
    found.trialsSettings = settingsOf(place.onlyKeys({"settings", "decoders"}).at("settings"), file);
    for (const JsonPlace& trial : place.at("decoders").list()) found.trials.push_back(trialOf(trial));
  }
  results.sweep = std::move(found.sweep);
  results.sweepSettings = found.sweepSettings;
  results.trials = std::move(found.trials);
  results.trialsSettings = found.trialsSettings;
}

} // namespace palp
