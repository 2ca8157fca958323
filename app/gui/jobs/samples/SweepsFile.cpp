#include "app/gui/jobs/samples/SweepsFile.h"

#include "app/gui/project/ProjectFields.h"
#include "model/base/Error.h"

#include <limits>

namespace palp {

namespace {

constexpr const char* kVersionKey = "palp_sweeps";
constexpr int kVersion = 1;
constexpr std::size_t kMostOutputs = 8; ///< of a decoder: forces and a position
constexpr double kLargest = 1e300;
constexpr Within kNotNegative{0, kLargest};

// Errors may be infinite or not a number: null in the file.

Json errorJson(double error) {
  return std::isfinite(error) ? jsonOf(error) : Json();
}

double readError(const JsonPlace& place) {
  return place.isNull() ? std::numeric_limits<double>::infinity() : place.number(-kLargest, kLargest);
}

void error(JsonFields& fields, const std::string& key, double& error) {
  fields.custom(
      key, JsonFields::kAlways, [&] { return errorJson(error); },
      [&](const JsonPlace& place) { error = readError(place); });
}

Json errorsJson(const Eigen::VectorXd& errors) {
  Json all = Json::array();
  for (const double error : errors) all.push_back(errorJson(error));
  return all;
}

Eigen::VectorXd readErrors(const JsonPlace& place) {
  const std::vector<JsonPlace> entries = place.list();
  if (entries.size() > kMostOutputs) place.refuse("a list of at most " + std::to_string(kMostOutputs) + " numbers");
  Eigen::VectorXd errors(static_cast<Eigen::Index>(entries.size()));
  for (std::size_t k = 0; k < entries.size(); ++k) errors(static_cast<Eigen::Index>(k)) = readError(entries[k]);
  return errors;
}

void errors(JsonFields& fields, const std::string& key, Eigen::VectorXd& errors) {
  fields.custom(
      key, JsonFields::kAlways, [&] { return errorsJson(errors); },
      [&](const JsonPlace& place) { errors = readErrors(place); });
}

/// The samples of a sweep, as far as a file of samples identifies them.
Json samplesJson(const NetworkSamples& samples) {
  return {{"design", samples.training.origin.designFingerprint},
          {"training", samples.training.size()},
          {"test", samples.test.size()},
          {"seed", std::to_string(samples.training.origin.seed)}};
}

} // namespace

static void describe(JsonFields& fields, PredictionError& error) { // without its floor: nothing here shows it
  errors(fields, "eq13_percent", error.eq13Percent);
  errors(fields, "eq13_floored_percent", error.eq13FlooredPercent);
  errors(fields, "mean_absolute", error.meanAbsolute);
  errors(fields, "rmse_percent_of_range", error.rmsePercentOfRange);
}

static void describe(JsonFields& fields, SweepPoint& point) {
  fields.field("spread", point.spread, kNotNegative);
  point.report.spread = point.spread;
  fields.field("error", point.error);
  errors(fields, "leave_one_out_N", point.report.leaveOneOut);
  error(fields, "condition", point.report.condition);
  fields.field("ridge", point.report.ridge, kNotNegative);
  fields.field("centers", point.report.centers, Within{0, std::numeric_limits<int>::max()});
  fields.field("seconds", point.report.seconds, kNotNegative);
}

static void describe(JsonFields& fields, DecoderTrial& trial) {
  fields.field("decoder", trial.kind, kDecoderKinds);
  fields.field("error", trial.error);
  if (fields.form("place_mm", trial.place.has_value())) {
    const PlaceError place = trial.place.value_or(PlaceError{});
    std::array<double, 3> numbers{place.median_mm, place.rms_mm.x(), place.rms_mm.y()};
    fields.branch("place_mm", numbers);
    trial.place = PlaceError{{numbers[1], numbers[2]}, numbers[0], {}};
  }
  fields.field("spread", trial.spread, kNotNegative);
  fields.field("seconds", trial.seconds, kNotNegative);
  fields.field("microseconds_per_sample", trial.microsecondsPerSample, kNotNegative);
  std::string refusal = trial.refusal.toStdString();
  fields.field("not_trained_because", refusal);
  trial.refusal = QString::fromStdString(refusal);
}

static void describe(JsonFields& fields, NetworkResults& results) {
  int version = kVersion;
  fields.field(kVersionKey, version, Within{1, kVersion});
  const std::shared_ptr<const NetworkSamples> samples = results.samples;
  fields.custom(
      "samples", JsonFields::kAlways, [&] { return samplesJson(*samples); }, [](const JsonPlace& /*place*/) {});
  if (fields.form("sweep", !results.sweep.empty()))
    fields.group("sweep", false, [&](JsonFields& sweep) {
      sweep.field("settings", results.sweepSettings);
      sweep.field("points", results.sweep);
    });
  if (fields.form("comparison", !results.trials.empty()))
    fields.group("comparison", false, [&](JsonFields& comparison) {
      comparison.field("settings", results.trialsSettings);
      comparison.field("decoders", results.trials);
    });
}

QByteArray sweepsText(const NetworkResults& results) {
  return QByteArray::fromStdString(jsonText(jsonOf(results), 4) + "\n");
}

void parseSweeps(const QByteArray& text, const QString& file, NetworkResults& results) {
  const std::string name = file.toStdString();
  const Json json = parseJson({text.data(), static_cast<std::size_t>(text.size())}, name);
  const JsonPlace root(json, name);
  formatVersion(root, kVersionKey, kVersion);
  if (root.has("samples") && root.at("samples").asJson() != jsonText(samplesJson(*results.samples)))
    throw Error(name + ": its sweep and comparison belong to other samples than the project's; they are not shown");
  auto found = JsonFields::read<NetworkResults>(root);
  results.sweep = std::move(found.sweep);
  results.sweepSettings = found.sweepSettings;
  results.trials = std::move(found.trials);
  results.trialsSettings = found.trialsSettings;
}

} // namespace palp
