#include "app/gui/project/ProjectFile.h"

#include "app/gui/project/ProjectFields.h"

#include "app/study/decoding/TrainOptionTable.h"
#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "model/base/Error.h"
#include "model/base/NumberText.h"
#include "model/base/Text.h"

#include <QFile>

namespace palp {

namespace {

constexpr int kVersion = 2; ///< 1 had no view, and perhaps no live
constexpr const char* kVersionKey = "palp_project";
constexpr NamedEnum kAxes("axis", std::array{std::pair{0, "x"}, std::pair{1, "y"}, std::pair{2, "z"}});
constexpr Within kIndices{0, 10000}; ///< of an area or a wire: more than any design has

bool isNumber(const TrainOption& option) {
  return option.form != TrainOption::Form::Text && option.form != TrainOption::Form::Choice;
}

Json optionJson(const TrainOption& option, const NetworkSettings& network) {
  const std::string text = option.text(network);
  return isNumber(option) ? jsonOf(numberIn(text).value()) : Json(text);
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

void range(JsonFields& fields, const std::string& key, std::optional<std::array<double, 2>>& range) {
  fields.sparse(key, range);
  if (range) fields.require(key, (*range)[0] < (*range)[1], "two numbers, the smaller one first");
}

template <class Struct> QByteArray fileText(const Struct& value) {
  return QByteArray::fromStdString(jsonText(jsonOf(value), 4) + "\n");
}

void requireBuildable(const SensorDesign& design, const std::string& where) {
  const std::vector<DesignFault> faults = check(design);
  if (!faults.empty()) throw Error(where + faults[0].key + ": " + faults[0].sentence);
}

} // namespace

static void describe(JsonFields& fields, MeshOptions& mesh) {
  fields.sparse("mesh_size_mm", mesh.meshSize_mm, Within{0.01, 1000});
  fields.sparse("mapped", mesh.mapped, Within{1, 1000});
}

void describe(JsonFields& fields, NetworkSettings& network) {
  constexpr Within kSpreads{1e-6, 1e6};
  fields.field("automatic_spread", network.automaticSpread);
  fields.field("spread", network.chosenSpread, kSpreads);
  fields.field("sweep_from", network.sweepFrom, kSpreads);
  fields.field("sweep_to", network.sweepTo, Within{network.sweepFrom, 1e6});
  fields.field("sweep_count", network.sweepCount, Within{2, 100});
  int centers = network.centers.value_or(0);
  fields.added("centers", centers, Within{0, 100000});
  if (centers > 0) network.centers = centers;
  fields.sparse("test_noise", network.testNoise, 0, Within{0, 0.5});
  fields.sparse("all_centers", network.allCenters, false);
  for (const TrainOption& option : trainOptionTable())
    if (!option.key.empty())
      fields.custom(
          option.key, {option.alwaysInFiles, option.alwaysInFiles, option.alwaysInFiles || option.isSet(network)},
          [&] { return optionJson(option, network); },
          [&](const JsonPlace& place) { readOption(option, place, network); });
}

static void describe(JsonFields& fields, CutPlane& cut) {
  fields.field("axis", cut.axis, kAxes);
  fields.field("at_mm", cut.at_mm, Within{0, 1e4});
}

void describe(JsonFields& fields, ViewSettings& view) {
  const ViewSettings usual;
  fields.field("scene", view.scene);
  fields.field("quantity", view.quantity, kQuantities);
  fields.sparse("warp_factor", view.deformationScale, Within{0, 1e6});
  fields.custom(
      "clip_y_mm", {false, false, false}, [] { return Json(); }, // of older files
      [&](const JsonPlace& place) {
        view.cut = CutPlane{1, place.number(0, 1e4)};
      });
  fields.sparse("cut", view.cut);
  fields.sparse("color_map", view.colorMap, kColorMaps);
  range(fields, "color_range", view.colorRange);
  range(fields, "difference_range", view.differenceRange);
  fields.sparse("extremes", view.extremes, false);
  fields.sparse("less_kept", view.lessReference, false);
  fields.sparse("uniform", view.uniform, false);
  fields.sparse("map_quantity", view.mapQuantity, usual.mapQuantity);
  fields.sparse("map_on_block", view.mapOnBlock, true);
  fields.sparse("current_way", view.currentPaths, false);
  fields.field("ghost", view.ghost);
  fields.field("electrodes", view.electrodes);
  fields.field("arrows", view.arrows);
  fields.field("outlines", view.outlines);
  fields.field("edges", view.edges);
  fields.sparse("lit_cell", view.litCell, kIndices);
  fields.field("row_wire", view.rowWire, kIndices);
  fields.field("line_from_mm", view.lineFrom_mm);
  fields.field("line_to_mm", view.lineTo_mm);
  fields.field("mesh", view.mesh);
  fields.field("resistance_noise", view.resistanceNoise, Within{1e-7, 0.1});
  fields.field("resistance", view.resistance, kResistanceKinds);
  range(fields, "resistance_range", view.resistanceRange);
  fields.field("cell", view.cell, kIndices);
  fields.field("test_area", view.testArea, kIndices);
  fields.added("report_per_area", view.reportPerArea, Within{5, 100000});
}

static void describe(JsonFields& fields, Project& project) {
  int version = kVersion;
  fields.field(kVersionKey, version, Within{1, kVersion});
  fields.field("design", project.design);
  fields.field("load", project.load);
  fields.sparse("path", project.path);
  fields.field("mesh", project.mesh);
  fields.field("samples", project.samples);
  fields.field("network", project.network);
  if (version >= 2) fields.branch("view", project.view);
  fields.added("live", project.live);
  fields.sparse("more_boards", project.moreBoards, {});
  fields.require("more_boards", project.moreBoards.size() < Project::kMostBoards,
                 "at most " + std::to_string(Project::kMostBoards - 1) + " further boards");
  fields.sparse("kept_design", project.kept);
  fields.sparse("design_studies", project.studies, {});
}

namespace {

Project projectOf(const JsonPlace& root, const std::string& file) {
  formatVersion(root, kVersionKey, kVersion); // first: a newer file may well have other keys
  Project project = JsonFields::read<Project>(root);
  requireBuildable(project.design, file + ": design.");
  if (project.kept) requireBuildable(*project.kept, file + ": kept_design.");
  if (const auto wrong = whyInvalid(project.load, project.design)) throw Error(file + ": load: " + *wrong);
  if (project.path)
    if (const auto wrong = whyInvalid(project.load, *project.path, project.design))
      throw Error(file + ": path: " + *wrong);
  return project;
}

} // namespace

QByteArray networkText(const NetworkSettings& network) {
  return fileText(network);
}

NetworkSettings parseNetwork(const QByteArray& text, const QString& file) {
  const std::string name = file.toStdString();
  const Json json = parseJson({text.data(), static_cast<std::size_t>(text.size())}, name);
  return JsonFields::read<NetworkSettings>(JsonPlace(json, name));
}

QByteArray projectText(const Project& project) {
  return fileText(project);
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
