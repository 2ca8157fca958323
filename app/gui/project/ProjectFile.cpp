#include "app/gui/project/ProjectFile.h"

#include "app/gui/project/DesignStudiesFile.h"
#include "app/gui/project/LiveSettingsFile.h"
#include "app/gui/project/SampleSettingsFile.h"

#include "app/study/decoding/TrainOptionTable.h"
#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "io/StrictJson.h"
#include "model/base/Error.h"
#include "model/base/NumberText.h"
#include "model/base/Text.h"

#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <cmath>

namespace palp {

namespace {

constexpr int kVersion = 2; ///< 1 had no view, and perhaps no live
constexpr const char* kVersionKey = "palp_project";
constexpr NamedEnum kAxes("axis", std::array{std::pair{0, "x"}, std::pair{1, "y"}, std::pair{2, "z"}});
constexpr int kLargestIndex = 10000; ///< of an area or a wire: more than any design has

QJsonObject meshJson(const MeshOptions& mesh) {
  QJsonObject object;
  if (mesh.meshSize_mm) object["mesh_size_mm"] = *mesh.meshSize_mm;
  if (mesh.mapped) object["mapped"] = QJsonArray{(*mesh.mapped)[0], (*mesh.mapped)[1], (*mesh.mapped)[2]};
  return object;
}

MeshOptions meshOf(const JsonPlace& place) {
  place.onlyKeys({}, {"mesh_size_mm", "mapped"});
  MeshOptions mesh;
  if (place.has("mesh_size_mm")) mesh.meshSize_mm = place.at("mesh_size_mm").number(0.01, 1000);
  if (place.has("mapped")) {
    const std::vector<JsonPlace> counts = place.at("mapped").list();
    if (counts.size() != 3) place.at("mapped").refuse("three whole numbers, 1 to 1000");
    mesh.mapped = {counts[0].integer(1, 1000), counts[1].integer(1, 1000), counts[2].integer(1, 1000)};
  }
  return mesh;
}

bool isNumber(const TrainOption& option) {
  return option.form != TrainOption::Form::Text && option.form != TrainOption::Form::Choice;
}

QJsonObject networkJson(const NetworkSettings& network) {
  QJsonObject object{{"automatic_spread", network.automaticSpread},
                     {"spread", network.chosenSpread},
                     {"centers", network.centers.value_or(0)},
                     {"sweep_from", network.sweepFrom},
                     {"sweep_to", network.sweepTo},
                     {"sweep_count", network.sweepCount}};
  if (network.testNoise > 0) object["test_noise"] = network.testNoise;
  if (network.allCenters) object["all_centers"] = true;
  for (const TrainOption& option : trainOptionTable()) {
    if (option.key.empty() || (!option.alwaysInFiles && !option.isSet(network))) continue;
    const std::string text = option.text(network);
    const QString key = QString::fromStdString(option.key);
    object[key] = isNumber(option) ? QJsonValue(numberIn(text).value()) : QJsonValue(QString::fromStdString(text));
  }
  return object;
}

void readOption(const TrainOption& option, const JsonPlace& place, NetworkSettings& network) {
  using Form = TrainOption::Form;
  const std::string value =
      option.form == Form::WholeNumber
          ? std::to_string(place.integer(static_cast<int>(option.low), static_cast<int>(option.high)))
      : isNumber(option) ? text(place.number(option.low, option.high))
                         : place.string();
  if (!option.set(network, value)) place.refuse(option.allowed);
}

NetworkSettings networkOf(const JsonPlace& place) {
  std::vector<std::string> required{"automatic_spread", "spread", "sweep_from", "sweep_to", "sweep_count"};
  std::vector<std::string> optional{"centers", "test_noise", "all_centers"};
  for (const TrainOption& option : trainOptionTable())
    if (!option.key.empty()) (option.alwaysInFiles ? required : optional).push_back(option.key);
  place.onlyKeys(required, optional);
  NetworkSettings network;
  network.automaticSpread = place.at("automatic_spread").boolean();
  network.chosenSpread = place.at("spread").number(1e-6, 1e6);
  if (place.has("centers"))
    if (const int centers = place.at("centers").integer(0, 100000); centers > 0) network.centers = centers;
  network.sweepFrom = place.at("sweep_from").number(1e-6, 1e6);
  network.sweepTo = place.at("sweep_to").number(network.sweepFrom, 1e6);
  network.sweepCount = place.at("sweep_count").integer(2, 100);
  if (place.has("test_noise")) network.testNoise = place.at("test_noise").number(0, 0.5);
  if (place.has("all_centers")) network.allCenters = place.at("all_centers").boolean();
  for (const TrainOption& option : trainOptionTable())
    if (!option.key.empty() && place.has(option.key)) readOption(option, place.at(option.key), network);
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
                     {"resistance", QString::fromStdString(kResistanceKinds.name(view.resistance))},
                     {"cell", cell(view.cell)},
                     {"test_area", view.testArea},
                     {"report_per_area", view.reportPerArea}};
  if (view.warpFactor) object["warp_factor"] = *view.warpFactor;
  if (view.cut)
    object["cut"] =
        QJsonObject{{"axis", QString::fromStdString(kAxes.name(view.cut->axis))}, {"at_mm", view.cut->at_mm}};
  if (view.colorMap) object["color_map"] = QString::fromStdString(kColorMaps.name(*view.colorMap));
  if (view.colorRange) object["color_range"] = QJsonArray{(*view.colorRange)[0], (*view.colorRange)[1]};
  if (view.differenceRange)
    object["difference_range"] = QJsonArray{(*view.differenceRange)[0], (*view.differenceRange)[1]};
  if (view.extremes) object["extremes"] = true;
  if (view.lessKept) object["less_kept"] = true;
  if (view.uniform) object["uniform"] = true;
  if (view.mapQuantity != ViewSettings().mapQuantity) object["map_quantity"] = QString::fromStdString(view.mapQuantity);
  if (!view.mapOnBlock) object["map_on_block"] = false;
  if (view.currentWay) object["current_way"] = true;
  if (view.litCell) object["lit_cell"] = cell(*view.litCell);
  if (view.resistanceRange)
    object["resistance_range"] = QJsonArray{(*view.resistanceRange)[0], (*view.resistanceRange)[1]};
  return object;
}

std::array<int, 2> cellOf(const JsonPlace& place) {
  const std::vector<JsonPlace> cell = place.list();
  if (cell.size() != 2) place.refuse("a row-wire and a column-wire, whole numbers from 0 on");
  return {cell[0].integer(0, kLargestIndex), cell[1].integer(0, kLargestIndex)};
}

std::array<double, 3> placeOf(const JsonPlace& place) {
  const std::vector<double> numbers = place.numbers(3);
  return {numbers[0], numbers[1], numbers[2]};
}

std::array<double, 2> rangeOf(const JsonPlace& place) {
  const std::vector<double> range = place.numbers(2);
  if (!(range[0] < range[1])) place.refuse("two numbers, the smaller one first");
  return {range[0], range[1]};
}

CutPlane cutOf(const JsonPlace& place) {
  place.onlyKeys({"axis", "at_mm"});
  return {place.at("axis").named(kAxes), place.at("at_mm").number(0, 1e4)};
}

ViewSettings viewOf(const JsonPlace& place) {
  place.onlyKeys({"scene", "quantity", "ghost", "electrodes", "arrows", "outlines", "edges", "row_wire", "line_from_mm",
                  "line_to_mm", "mesh", "resistance_noise", "resistance", "cell", "test_area"},
                 {"warp_factor", "clip_y_mm", "cut", "color_map", "color_range", "difference_range", "extremes",
                  "lit_cell", "resistance_range", "less_kept", "current_way", "uniform", "map_quantity", "map_on_block",
                  "report_per_area"});
  ViewSettings view;
  view.scene = place.at("scene").string();
  view.quantity = place.at("quantity").named(kQuantities);
  if (place.has("warp_factor")) view.warpFactor = place.at("warp_factor").number(0, 1e6);
  if (place.has("clip_y_mm")) view.cut = CutPlane{1, place.at("clip_y_mm").number(0, 1e4)}; // of older files
  if (place.has("cut")) view.cut = cutOf(place.at("cut"));
  if (place.has("color_map")) view.colorMap = place.at("color_map").named(kColorMaps);
  if (place.has("color_range")) view.colorRange = rangeOf(place.at("color_range"));
  if (place.has("difference_range")) view.differenceRange = rangeOf(place.at("difference_range"));
  if (place.has("extremes")) view.extremes = place.at("extremes").boolean();
  if (place.has("less_kept")) view.lessKept = place.at("less_kept").boolean();
  if (place.has("uniform")) view.uniform = place.at("uniform").boolean();
  if (place.has("map_quantity")) view.mapQuantity = place.at("map_quantity").string();
  if (place.has("map_on_block")) view.mapOnBlock = place.at("map_on_block").boolean();
  if (place.has("current_way")) view.currentWay = place.at("current_way").boolean();
  view.ghost = place.at("ghost").boolean();
  view.electrodes = place.at("electrodes").boolean();
  view.arrows = place.at("arrows").boolean();
  view.outlines = place.at("outlines").boolean();
  view.edges = place.at("edges").boolean();
  if (place.has("lit_cell")) view.litCell = cellOf(place.at("lit_cell"));
  view.rowWire = place.at("row_wire").integer(0, kLargestIndex);
  view.lineFrom_mm = placeOf(place.at("line_from_mm"));
  view.lineTo_mm = placeOf(place.at("line_to_mm"));
  view.mesh = place.at("mesh").boolean();
  view.resistanceNoise = place.at("resistance_noise").number(1e-7, 0.1);
  view.resistance = place.at("resistance").named(kResistanceKinds);
  if (place.has("resistance_range")) view.resistanceRange = rangeOf(place.at("resistance_range"));
  view.cell = cellOf(place.at("cell"));
  view.testArea = place.at("test_area").integer(0, kLargestIndex);
  if (place.has("report_per_area")) view.reportPerArea = place.at("report_per_area").integer(5, 100000);
  return view;
}

void requireBuildable(const SensorDesign& design, const std::string& where) {
  const std::vector<DesignFault> faults = check(design);
  if (!faults.empty()) throw Error(where + faults[0].key + ": " + faults[0].sentence);
}

Project projectOf(const JsonPlace& root, const std::string& file) {
  const int version = formatVersion(root, kVersionKey, kVersion); // first: a newer file may well have other keys
  root.onlyKeys({kVersionKey, "design", "load", "mesh", "samples", "network"},
                {"view", "live", "more_boards", "kept_design", "design_studies", "path"});
  Project project;
  project.design = readDesign(root.at("design"));
  requireBuildable(project.design, file + ": design.");
  project.load = loadOf(root.at("load"));
  if (const auto wrong = whyInvalid(project.load, project.design)) throw Error(file + ": load: " + *wrong);
  if (root.has("path")) {
    project.path = pathOf(root.at("path"));
    if (const auto wrong = whyInvalid(project.load, *project.path, project.design))
      throw Error(file + ": path: " + *wrong);
  }
  project.mesh = meshOf(root.at("mesh"));
  project.samples = samplesOf(root.at("samples"));
  project.network = networkOf(root.at("network"));
  if (version >= 2) project.view = viewOf(root.at("view"));
  if (root.has("live")) project.live = liveOf(root.at("live")); // not in the files of the first version
  if (root.has("more_boards")) project.moreBoards = boardsOf(root.at("more_boards"));
  if (root.has("kept_design")) {
    requireBuildable(project.kept.emplace(readDesign(root.at("kept_design"))), file + ": kept_design.");
  }
  if (root.has("design_studies")) project.studies = studiesOf(root.at("design_studies"));
  return project;
}

} // namespace

QByteArray networkText(const NetworkSettings& network) {
  return QJsonDocument(networkJson(network)).toJson();
}

NetworkSettings parseNetwork(const QByteArray& text, const QString& file) {
  const std::string name = file.toStdString();
  const Json json = parseJson({text.data(), static_cast<std::size_t>(text.size())}, name);
  return networkOf(JsonPlace(json, name));
}

QByteArray projectText(const Project& project) {
  const auto designJson = [](const SensorDesign& design) {
    return QJsonDocument::fromJson(QByteArray::fromStdString(toJson(design))).object();
  };
  QJsonObject root{{kVersionKey, kVersion},
                   {"design", designJson(project.design)},
                   {"load", loadJson(project.load)},
                   {"mesh", meshJson(project.mesh)},
                   {"samples", samplesJson(project.samples)},
                   {"network", networkJson(project.network)},
                   {"view", viewJson(project.view)},
                   {"live", liveJson(project.live)}};
  if (project.path) root["path"] = pathJson(*project.path);
  if (!project.moreBoards.empty()) root["more_boards"] = boardsJson(project.moreBoards);
  if (project.kept) root["kept_design"] = designJson(*project.kept);
  if (const QJsonObject studies = studiesJson(project.studies); !studies.isEmpty()) root["design_studies"] = studies;
  return QJsonDocument(root).toJson();
}

void saveProject(const std::filesystem::path& path, const Project& project) {
  writeFile(path, projectText(project).toStdString(), true);
}

Project parseProject(const QByteArray& text, const QString& file, const Project& base) {
  const std::string name = file.toStdString();
  const Json json = parseJson({text.data(), static_cast<std::size_t>(text.size())}, name);
  const JsonPlace root(json, name);
  if (root.has(kVersionKey)) return projectOf(root, name);
  if (!root.has("palp_design"))
    throw Error(name + ": not a design or project file: expected the key palp_project or palp_design");
  Project project = base;
  project.design = readDesign(root);
  requireBuildable(project.design, name + ": ");
  for (std::size_t board = 0; board < project.boards(); ++board) { // they are of the project that is left
    project.board(board).frames.reset();
    project.board(board).calibrated.reset();
  }
  if (whyInvalid(project.load, project.design)) project.load = {{{0, {0, 0, -1}}}, {}};
  return project;
}

Project loadProject(const std::filesystem::path& path, const Project& base) {
  const QString name = QString::fromStdString(path.string());
  QFile file(name);
  if (!file.open(QIODevice::ReadOnly))
    throw Error(path.string() + ": cannot be read (" + file.errorString().toStdString() +
                "); expected a design or project file");
  return parseProject(file.readAll(), name, base);
}

} // namespace palp
