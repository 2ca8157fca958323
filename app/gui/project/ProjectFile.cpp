#include "app/gui/project/ProjectFile.h"

#include "app/gui/project/ProjectPlace.h"
#include "io/DesignFile.h"
#include "model/base/Error.h"

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>
#include <QSaveFile>

namespace palp {

namespace {

using Place = ProjectPlace;

constexpr int kVersion = 2; ///< 1 had no view
constexpr const char* kVersionKey = "palp_project";
const QStringList kResistanceKinds{"R", "dR", "dR/R"}; ///< in the enumeration's order

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
    const Eigen::Vector3d given = place.numbers("mapped", 3);
    const bool whole = given == given.array().floor().matrix();
    if (!whole || !(given.minCoeff() >= 1 && given.maxCoeff() <= 1000))
      place.refuse("mapped", "three whole numbers, 1 to 1000");
    const Eigen::Vector3i counts = given.cast<int>();
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
          {"centers", network.centers},
          {"noise", network.noise},
          {"sweep_from", network.sweepFrom},
          {"sweep_to", network.sweepTo},
          {"sweep_count", network.sweepCount}};
}

NetworkSettings networkOf(const Place& place) {
  place.onlyKeys({"input", "mode", "decoder", "rows", "automatic_spread", "spread", "centers", "noise", "sweep_from",
                  "sweep_to", "sweep_count"});
  QStringList decoders;
  for (const DecoderKind kind : allDecoderKinds()) decoders << QString::fromStdString(name(kind));
  NetworkSettings network;
  network.input = kInputKinds.value(place.word("input", {"displacement", "resistance"}).toStdString());
  network.mode = kDecoderModes.value(place.word("mode", {"default", "paper"}).toStdString());
  network.decoder = kDecoderKinds.value(place.word("decoder", decoders).toStdString());
  network.rows = place.word("rows").toStdString();
  network.automaticSpread = place.boolean("automatic_spread");
  network.spread = place.number("spread", 1e-6, 1e6);
  if (place.has("centers")) network.centers = place.integer("centers", 0, 100000);
  network.noise = place.number("noise", 0, 1);
  network.sweepFrom = place.number("sweep_from", 1e-6, 1e6);
  network.sweepTo = place.number("sweep_to", network.sweepFrom, 1e6);
  network.sweepCount = place.integer("sweep_count", 2, 100);
  return network;
}

QJsonObject viewJson(const ViewSettings& view) {
  const auto cell = [](const std::array<int, 2>& at) { return QJsonArray{at[0], at[1]}; };
  const auto place = [](const std::array<double, 3>& at) { return QJsonArray{at[0], at[1], at[2]}; };
  QJsonObject object{{"scene", QString::fromStdString(view.scene)},
                     {"quantity", QString::fromStdString(quantityName(view.quantity))},
                     {"ghost", view.ghost},
                     {"electrodes", view.electrodes},
                     {"arrows", view.arrows},
                     {"outlines", view.outlines},
                     {"edges", view.edges},
                     {"row_wire", view.rowWire},
                     {"line_from_mm", place(view.lineFrom_mm)},
                     {"line_to_mm", place(view.lineTo_mm)},
                     {"mesh", view.mesh},
                     {"resistance_noise", view.resistanceNoise},
                     {"resistance", kResistanceKinds[static_cast<int>(view.resistance)]},
                     {"cell", cell(view.cell)},
                     {"test_area", view.testArea}};
  if (view.warpFactor) object["warp_factor"] = *view.warpFactor;
  if (view.clipY_mm) object["clip_y_mm"] = *view.clipY_mm;
  if (view.litCell) object["lit_cell"] = cell(*view.litCell);
  if (view.resistanceRange)
    object["resistance_range"] = QJsonArray{(*view.resistanceRange)[0], (*view.resistanceRange)[1]};
  return object;
}

std::array<int, 2> cellOf(const Place& place, const QString& key) {
  const Eigen::VectorXd numbers = place.numbers(key, 2);
  const bool whole = numbers == numbers.array().floor().matrix();
  if (!whole || !(numbers.minCoeff() >= 0 && numbers.maxCoeff() < 10000))
    place.refuse(key, "a row-wire and a column-wire, whole numbers from 0 on");
  return {static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
}

std::array<double, 3> placeOf(const Place& place, const QString& key) {
  const Eigen::VectorXd numbers = place.numbers(key, 3);
  return {numbers[0], numbers[1], numbers[2]};
}

ViewSettings viewOf(const Place& place) {
  place.onlyKeys({"scene", "quantity", "warp_factor", "clip_y_mm", "ghost", "electrodes", "arrows", "outlines", "edges",
                  "lit_cell", "row_wire", "line_from_mm", "line_to_mm", "mesh", "resistance_noise", "resistance",
                  "resistance_range", "cell", "test_area"});
  ViewSettings view;
  view.scene = place.word("scene").toStdString();
  QStringList quantities;
  for (const Quantity quantity : allQuantities()) quantities << QString::fromStdString(quantityName(quantity));
  view.quantity = allQuantities()[static_cast<std::size_t>(quantities.indexOf(place.word("quantity", quantities)))];
  if (place.has("warp_factor")) view.warpFactor = place.number("warp_factor", 0, 1e6);
  if (place.has("clip_y_mm")) view.clipY_mm = place.number("clip_y_mm", 0, 1e4);
  view.ghost = place.boolean("ghost");
  view.electrodes = place.boolean("electrodes");
  view.arrows = place.boolean("arrows");
  view.outlines = place.boolean("outlines");
  view.edges = place.boolean("edges");
  if (place.has("lit_cell")) view.litCell = cellOf(place, "lit_cell");
  view.rowWire = place.integer("row_wire", 0, 10000);
  view.lineFrom_mm = placeOf(place, "line_from_mm");
  view.lineTo_mm = placeOf(place, "line_to_mm");
  view.mesh = place.boolean("mesh");
  view.resistanceNoise = place.number("resistance_noise", 1e-7, 0.1);
  view.resistance = static_cast<ResistanceKind>(kResistanceKinds.indexOf(place.word("resistance", kResistanceKinds)));
  if (place.has("resistance_range")) {
    const Eigen::VectorXd range = place.numbers("resistance_range", 2);
    if (!(range[0] < range[1])) place.refuse("resistance_range", "two numbers, the smaller one first");
    view.resistanceRange = {range[0], range[1]};
  }
  view.cell = cellOf(place, "cell");
  view.testArea = place.integer("test_area", 0, 10000);
  return view;
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
  root.onlyKeys({kVersionKey, "design", "load", "mesh", "samples", "network", "view", "live"});
  const int version = root.integer(kVersionKey, 1, 1000000);
  if (version > kVersion) root.refuse(kVersionKey, QString("up to %1: the file is from a newer Palp").arg(kVersion));
  Project project;
  const QByteArray design = QJsonDocument(root.at("design").object()).toJson();
  project.design = parseDesign(design.toStdString(), (file + ": design").toStdString());
  requireValid(project.design);
  project.load = loadOf(root.at("load"));
  if (const auto wrong = whyInvalid(project.load, project.design))
    throw Error((file + ": load: " + QString::fromStdString(*wrong)).toStdString());
  project.mesh = meshOf(root.at("mesh"));
  const Place samples = root.at("samples");
  samples.onlyKeys({"per_area", "seed"});
  project.samples.perArea = samples.integer("per_area", 5, 100000);
  project.samples.seed = static_cast<std::uint64_t>(samples.integer("seed", 0, 1000000000));
  project.network = networkOf(root.at("network"));
  if (version >= 2) project.view = viewOf(root.at("view"));
  if (root.has("live")) project.live = liveOf(root.at("live")); // not in the files of the first version
  return project;
}

} // namespace

QByteArray projectText(const Project& project) {
  const QByteArray design = QByteArray::fromStdString(toJson(project.design));
  const QJsonObject root{{kVersionKey, kVersion},
                         {"design", QJsonDocument::fromJson(design).object()},
                         {"load", loadJson(project.load)},
                         {"mesh", meshJson(project.mesh)},
                         {"samples", QJsonObject{{"per_area", project.samples.perArea},
                                                 {"seed", static_cast<double>(project.samples.seed)}}},
                         {"network", networkJson(project.network)},
                         {"view", viewJson(project.view)},
                         {"live", liveJson(project.live)}};
  return QJsonDocument(root).toJson();
}

void saveProject(const std::filesystem::path& path, const Project& project) {
  QSaveFile file(QString::fromStdString(path.string()));
  const QByteArray text = projectText(project);
  if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size() || !file.commit())
    throw Error(path.string() + ": cannot be written (" + file.errorString().toStdString() +
                "); allowed is a file in a folder that exists and may be written to");
}

Project parseProject(const QByteArray& text, const QString& file, const Project& base) {
  const QJsonObject root = parse(text, file);
  if (root.contains(kVersionKey)) return projectOf(Place(root, file), file);
  Project project = base;
  project.design = parseDesign({text.data(), static_cast<std::size_t>(text.size())}, file.toStdString());
  const std::vector<DesignFault> faults = check(project.design);
  if (!faults.empty()) throw Error(file.toStdString() + ": " + faults[0].key + ": " + faults[0].sentence);
  if (whyInvalid(project.load, project.design)) project.load = {{{0, {0, 0, -1}}}, {}};
  return project;
}

Project loadProject(const std::filesystem::path& path, const Project& base) {
  const QString name = QString::fromStdString(path.string());
  QFile file(name);
  if (!file.open(QIODevice::ReadOnly))
    throw Error(path.string() + ": cannot be read (" + file.errorString().toStdString() +
                "); allowed is a design or project file");
  return parseProject(file.readAll(), name, base);
}

} // namespace palp
