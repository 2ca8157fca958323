#include "app/gui/ProjectFile.h"

#include "io/DesignFile.h"
#include "model/Error.h"

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSaveFile>

#include <cmath>

namespace palp {

namespace {

constexpr int kVersion = 1;
constexpr const char* kVersionKey = "palp_project";

/// An object of the file together with where it stands, for refusals of one sentence.
class Place {
public:
  Place(QJsonObject object, QString file, QString key = {})
      : object_(std::move(object)), file_(std::move(file)), key_(std::move(key)) {}

  [[noreturn]] void refuse(const QString& key, const QString& allowed) const {
    const QString where = key_.isEmpty() ? key : key_ + "." + key;
    const QJsonValue value = object_.value(key);
    const QString text =
        value.isUndefined() ? "missing" : QJsonDocument(QJsonArray{value}).toJson(QJsonDocument::Compact);
    throw Error((file_ + ": " + where + ": " + text + "; allowed is " + allowed).toStdString());
  }
  void onlyKeys(const QStringList& keys) const {
    for (const QString& key : object_.keys())
      if (!keys.contains(key)) refuse(key, "one of " + keys.join(", ") + " as a key");
  }
  [[nodiscard]] double number(const QString& key, double low, double high) const {
    const QJsonValue value = object_.value(key);
    if (!value.isDouble() || !(value.toDouble() >= low && value.toDouble() <= high))
      refuse(key, QString("a number from %1 to %2").arg(low).arg(high));
    return value.toDouble();
  }
  [[nodiscard]] int integer(const QString& key, int low, int high) const {
    const double value = number(key, low, high);
    if (value != std::floor(value)) refuse(key, QString("a whole number from %1 to %2").arg(low).arg(high));
    return static_cast<int>(value);
  }
  [[nodiscard]] bool boolean(const QString& key) const {
    if (!object_.value(key).isBool()) refuse(key, "true or false");
    return object_.value(key).toBool();
  }
  [[nodiscard]] QString word(const QString& key, const QStringList& words = {}) const {
    const QJsonValue value = object_.value(key);
    if (!value.isString() || (!words.isEmpty() && !words.contains(value.toString())))
      refuse(key, words.isEmpty() ? "a text" : words.join(", "));
    return value.toString();
  }
  [[nodiscard]] Place at(const QString& key) const {
    if (!object_.value(key).isObject()) refuse(key, "an object");
    return {object_.value(key).toObject(), file_, key_.isEmpty() ? key : key_ + "." + key};
  }
  [[nodiscard]] std::vector<Place> list(const QString& key) const {
    if (!object_.value(key).isArray()) refuse(key, "a list of objects");
    std::vector<Place> places;
    for (const QJsonValue value : object_.value(key).toArray()) {
      if (!value.isObject()) refuse(key, "a list of objects");
      places.emplace_back(value.toObject(), file_, key + "[" + QString::number(places.size()) + "]");
    }
    return places;
  }
  [[nodiscard]] Eigen::VectorXd numbers(const QString& key, Eigen::Index count) const {
    const QJsonArray array = object_.value(key).toArray();
    bool good = object_.value(key).isArray() && array.size() == count;
    Eigen::VectorXd values(count);
    for (Eigen::Index k = 0; good && k < count; ++k) {
      good = array[k].isDouble();
      values[k] = array[k].toDouble();
    }
    if (!good) refuse(key, QString("a list of %1 numbers").arg(count));
    return values;
  }
  [[nodiscard]] bool has(const QString& key) const { return object_.contains(key); }
  [[nodiscard]] QJsonObject object() const { return object_; }

private:
  QJsonObject object_;
  QString file_;
  QString key_;
};

QJsonArray jsonOf(const Eigen::Ref<const Eigen::VectorXd>& values) {
  QJsonArray array;
  for (const double value : values) array.append(value);
  return array;
}

QJsonObject loadJson(const LoadCase& load) {
  QJsonArray areas;
  for (const AreaLoad& area : load.areas)
    areas.append(QJsonObject{{"area", area.area}, {"force_N", jsonOf(area.force_N)}});
  QJsonArray patches;
  for (const PatchLoad& patch : load.patches)
    patches.append(QJsonObject{
        {"centre_mm", jsonOf(patch.centre_mm)}, {"radius_mm", patch.radius_mm}, {"force_N", jsonOf(patch.force_N)}});
  return {{"areas", areas}, {"patches", patches}};
}

LoadCase loadOf(const Place& place) {
  place.onlyKeys({"areas", "patches"});
  LoadCase load;
  for (const Place& area : place.list("areas")) {
    area.onlyKeys({"area", "force_N"});
    load.areas.push_back({area.integer("area", 0, 10000), area.numbers("force_N", 3)});
  }
  for (const Place& patch : place.list("patches")) {
    patch.onlyKeys({"centre_mm", "radius_mm", "force_N"});
    load.patches.push_back(
        {patch.numbers("centre_mm", 2), patch.number("radius_mm", 0, 1e4), patch.numbers("force_N", 3)});
  }
  return load;
}

QJsonObject meshJson(const MeshOptions& mesh) {
  QJsonObject object;
  if (mesh.meshSize_mm) object["mesh_size_mm"] = *mesh.meshSize_mm;
  if (mesh.mapped) object["mapped"] = QJsonArray{(*mesh.mapped)[0], (*mesh.mapped)[1], (*mesh.mapped)[2]};
  return object;
}

MeshOptions meshOf(const Place& place) {
  place.onlyKeys({"mesh_size_mm", "mapped"});
  MeshOptions mesh;
  if (place.has("mesh_size_mm")) mesh.meshSize_mm = place.number("mesh_size_mm", 0.01, 1000);
  if (place.has("mapped")) {
    const Eigen::Vector3i counts = place.numbers("mapped", 3).cast<int>();
    if (counts.minCoeff() < 1) place.refuse("mapped", "three whole numbers from 1");
    mesh.mapped = {counts[0], counts[1], counts[2]};
  }
  return mesh;
}

QJsonObject networkJson(const NetworkSettings& network) {
  return {{"input", QString::fromStdString(name(network.input))},
          {"mode", QString::fromStdString(name(network.mode))},
          {"decoder", QString::fromStdString(name(network.decoder))},
          {"rows", QString::fromStdString(network.rows)},
          {"automatic_spread", network.automaticSpread},
          {"spread", network.spread},
          {"noise", network.noise},
          {"sweep_from", network.sweepFrom},
          {"sweep_to", network.sweepTo},
          {"sweep_count", network.sweepCount}};
}

NetworkSettings networkOf(const Place& place) {
  place.onlyKeys({"input", "mode", "decoder", "rows", "automatic_spread", "spread", "noise", "sweep_from", "sweep_to",
                  "sweep_count"});
  QStringList decoders;
  for (const DecoderKind kind : allDecoderKinds()) decoders << QString::fromStdString(name(kind));
  NetworkSettings network;
  network.input = inputKindNamed(place.word("input", {"displacement", "resistance"}).toStdString());
  network.mode = networkModeNamed(place.word("mode", {"default", "paper"}).toStdString());
  network.decoder = decoderKindNamed(place.word("decoder", decoders).toStdString());
  network.rows = place.word("rows").toStdString();
  network.automaticSpread = place.boolean("automatic_spread");
  network.spread = place.number("spread", 1e-6, 1e6);
  network.noise = place.number("noise", 0, 1);
  network.sweepFrom = place.number("sweep_from", 1e-6, 1e6);
  network.sweepTo = place.number("sweep_to", network.sweepFrom, 1e6);
  network.sweepCount = place.integer("sweep_count", 2, 100);
  return network;
}

QJsonObject liveJson(const LiveSettings& live) {
  const SimulationSettings& simulation = live.simulation;
  return {{"source", QString::fromStdString(name(live.source))},
          {"device", QString::fromStdString(live.device)},
          {"recording", QString::fromStdString(live.recording)},
          {"replay_speed", live.replaySpeed},
          {"rate_Hz", live.rate_Hz},
          {"row", live.row},
          {"network", QString::fromStdString(live.network)},
          {"tare_frames", live.tareFrames},
          {"arrow_mm_per_N", live.arrow_mm_per_N},
          {"change_percent", live.change_percent},
          {"window_s", live.window_s},
          {"simulation", QJsonObject{{"noise", simulation.noise},
                                     {"warming_degC", simulation.warming_degC},
                                     {"hysteresis_share", simulation.hysteresisShare},
                                     {"seed", static_cast<double>(simulation.seed)},
                                     {"open_row", simulation.openRow},
                                     {"open_column", simulation.openColumn},
                                     {"drop_every", simulation.dropEvery}}}};
}

LiveSettings liveOf(const Place& place) {
  place.onlyKeys({"source", "device", "recording", "replay_speed", "rate_Hz", "row", "network", "tare_frames",
                  "arrow_mm_per_N", "change_percent", "window_s", "simulation"});
  LiveSettings live;
  live.source =
      liveSourceKindNamed(place.word("source", {"automatic", "board", "simulated", "recording"}).toStdString());
  live.device = place.word("device").toStdString();
  live.recording = place.word("recording").toStdString();
  live.replaySpeed = place.number("replay_speed", 0, 1000);
  live.rate_Hz = place.integer("rate_Hz", 1, 8000);
  live.row = place.integer("row", -1, 31);
  live.network = place.word("network").toStdString();
  live.tareFrames = place.integer("tare_frames", 1, 100000);
  live.arrow_mm_per_N = place.number("arrow_mm_per_N", 0.1, 100);
  live.change_percent = place.number("change_percent", 1e-4, 100);
  live.window_s = place.number("window_s", 1, 60);
  const Place simulation = place.at("simulation");
  simulation.onlyKeys({"noise", "warming_degC", "hysteresis_share", "seed", "open_row", "open_column", "drop_every"});
  live.simulation.noise = simulation.number("noise", 0, 1);
  live.simulation.warming_degC = simulation.number("warming_degC", 0, 100);
  live.simulation.hysteresisShare = simulation.number("hysteresis_share", 0, 1);
  live.simulation.seed = static_cast<std::uint64_t>(simulation.integer("seed", 0, 1000000000));
  live.simulation.openRow = simulation.integer("open_row", -1, 31);
  live.simulation.openColumn = simulation.integer("open_column", -1, 254);
  live.simulation.dropEvery = simulation.integer("drop_every", 0, 100000);
  return live;
}

QJsonObject parse(const QByteArray& text, const QString& file) {
  QJsonParseError broken;
  const QJsonDocument document = QJsonDocument::fromJson(text, &broken);
  if (broken.error != QJsonParseError::NoError)
    throw Error((file + ": broken at byte " + QString::number(broken.offset) + " (" + broken.errorString() +
                 "); allowed is a JSON file of a design or a project")
                    .toStdString());
  if (!document.isObject())
    throw Error((file + ": no JSON object; allowed is a design or a project file").toStdString());
  return document.object();
}

Project projectOf(const Place& root, const QString& file) {
  root.onlyKeys({kVersionKey, "design", "load", "mesh", "samples", "network", "live"});
  if (root.integer(kVersionKey, 1, 1000000) > kVersion)
    root.refuse(kVersionKey, QString("up to %1: the file is from a newer Palp").arg(kVersion));
  Project project;
  const QByteArray design = QJsonDocument(root.at("design").object()).toJson();
  project.design = parseDesign(design.toStdString(), (file + ": design").toStdString());
  requireValid(project.design);
  project.load = loadOf(root.at("load"));
  if (const auto wrong = problem(project.load, project.design))
    throw Error((file + ": load: " + QString::fromStdString(*wrong)).toStdString());
  project.mesh = meshOf(root.at("mesh"));
  const Place samples = root.at("samples");
  samples.onlyKeys({"per_area", "seed"});
  project.samples.perArea = samples.integer("per_area", 5, 100000);
  project.samples.seed = static_cast<std::uint64_t>(samples.integer("seed", 0, 1000000000));
  project.network = networkOf(root.at("network"));
  if (root.has("live")) project.live = liveOf(root.at("live")); // not in the files of the first version
  return project;
}

} // namespace

void saveProject(const std::filesystem::path& path, const Project& project) {
  const QByteArray design = QByteArray::fromStdString(toJson(project.design));
  const QJsonObject root{{kVersionKey, kVersion},
                         {"design", QJsonDocument::fromJson(design).object()},
                         {"load", loadJson(project.load)},
                         {"mesh", meshJson(project.mesh)},
                         {"samples", QJsonObject{{"per_area", project.samples.perArea},
                                                 {"seed", static_cast<double>(project.samples.seed)}}},
                         {"network", networkJson(project.network)},
                         {"live", liveJson(project.live)}};
  QSaveFile file(QString::fromStdString(path.string()));
  const QByteArray text = QJsonDocument(root).toJson();
  if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size() || !file.commit())
    throw Error(path.string() + ": cannot be written (" + file.errorString().toStdString() +
                "); allowed is a file in a folder that exists and may be written to");
}

Project loadProject(const std::filesystem::path& path, const Project& base) {
  const QString name = QString::fromStdString(path.string());
  QFile file(name);
  if (!file.open(QIODevice::ReadOnly))
    throw Error(path.string() + ": cannot be read (" + file.errorString().toStdString() +
                "); allowed is a design or project file");
  const QJsonObject root = parse(file.readAll(), name);
  if (root.contains(kVersionKey)) return projectOf(Place(root, name), name);
  Project project = base;
  project.design = loadDesign(path);
  if (problem(project.load, project.design)) project.load = {{{0, {0, 0, -1}}}, {}};
  return project;
}

} // namespace palp
