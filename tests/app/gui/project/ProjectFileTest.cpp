#include "app/gui/project/ProjectFile.h"

#include "app/gui/project/Command.h"
#include "app/gui/project/live/BoardCalibration.h"
#include "app/study/Resources.h"
#include "io/DecoderFile.h"
#include "io/DesignFile.h"
#include "io/SampleFile.h"
#include "model/base/Error.h"

#include <QFile>
#include <QJsonDocument>
#include <QJsonObject>
#include <QTemporaryDir>
#include <SourceDir.h>

#include "tests/app/study/decoding/AnotherValue.h"

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <memory>
#include <sstream>

namespace palp {
namespace {

class ProjectFile : public testing::Test {
protected:
  std::filesystem::path path(const char* name) const { return folder_.filePath(name).toStdString(); }
  std::string refusal(const std::string& content) const {
    std::ofstream(path("bad.json")) << content;
    try {
      loadProject(path("bad.json"), exampleProject());
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  std::string savedText() const {
    saveProject(path("good.json"), exampleProject());
    std::stringstream text;
    text << std::ifstream(path("good.json")).rdbuf();
    return text.str();
  }
  static std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }

  QTemporaryDir folder_;
};

TEST_F(ProjectFile, RefusesCountsThatAreNotWhole) {
  Project project = exampleProject();
  project.mesh.mapped = {4, 5, 6};
  project.view.cell = {3, 7};
  const std::string text = projectText(project).toStdString();
  const auto refusalOf = [](const std::string& changed) -> std::string {
    try {
      parseProject(QByteArray::fromStdString(changed), "x.json", {});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  const auto compact = QJsonDocument::fromJson(QByteArray::fromStdString(text)).toJson(QJsonDocument::Compact);
  EXPECT_EQ(refusalOf(text), "");
  EXPECT_NE(refusalOf(with(compact.toStdString(), "[4,5,6]", "[4.5,5,6]")).find("mapped"), std::string::npos);
  EXPECT_NE(refusalOf(with(compact.toStdString(), "\"cell\":[3,7]", "\"cell\":[3,7.5]")).find("cell"),
            std::string::npos);
}

TEST_F(ProjectFile, TheFuzzersSeedsAreProjectsAndDesigns) {
  int seeds = 0;
  for (const auto& file : std::filesystem::directory_iterator(PALP_SOURCE_DIR "/tests/fuzz/projects")) {
    EXPECT_NO_THROW(loadProject(file.path(), exampleProject())) << file.path();
    ++seeds;
  }
  EXPECT_EQ(seeds, 3);
}

TEST_F(ProjectFile, ReadsBackEverythingThatWasSet) {
  Project project = exampleProject();
  project.design.material.poissonRatio = 0.4999;
  project.load.areas.push_back({5, {0.1, -0.25, 1.5}});
  project.load.patches.push_back({{10, 12}, 2.5, {0, 0, -3}});
  project.mesh.meshSize_mm = 1.75;
  project.samples = {33, 77};
  project.network.input = InputKind::Resistance;
  project.network.rows = "1,4,7";
  project.network.chosenSpread = 0.1;
  project.network.centers = 50;
  for (const TrainOption& option : trainOptionTable())
    if (!option.key.empty()) option.set(project.network, anotherValue(option));
  project.view = {"network",
                  Quantity::VonMises,
                  25.5,
                  CutPlane{2, 3.25},
                  ColorMap::Inferno,
                  std::array{-0.5, 0.75},
                  std::array{-0.1, 0.2},
                  true,
                  false,
                  false,
                  false,
                  false,
                  true,
                  std::array{3, 17},
                  9,
                  {1, 2, 3},
                  {4, 5, 4.5},
                  true,
                  5e-6,
                  ResistanceKind::Change,
                  std::array{-0.25, 0.5},
                  {7, 29},
                  true,
                  4,
                  true,
                  true,
                  "force",
                  false,
                  40};
  project.kept = paperDesign();
  project.kept->block_mm.z() = 6;
  saveProject(path("project.json"), project);
  EXPECT_EQ(loadProject(path("project.json"), exampleProject()), project);
}

TEST_F(ProjectFile, KeepsTheBoardsBesideTheFirstAndRefusesMoreThanFit) {
  Project project = exampleProject();
  project.moreBoards.resize(2);
  project.moreBoards[0].source = LiveSourceKind::Board;
  project.moreBoards[0].device = "PALP-B";
  project.moreBoards[1].simulation.seed = 7;
  const std::string text = projectText(project).toStdString();
  EXPECT_EQ(parseProject(QByteArray::fromStdString(text), "x.json", {}), project);
  EXPECT_EQ(savedText().find("more_boards"), std::string::npos) << "one board needs no list";
  const std::string wrong = refusal(with(text, "\"device\": \"PALP-B\"", "\"device\": 3"));
  EXPECT_NE(wrong.find("more_boards[0].device"), std::string::npos) << wrong;
  project.moreBoards.resize(Project::kMostBoards);
  const std::string many = refusal(projectText(project).toStdString());
  EXPECT_NE(many.find("at most 3 further boards"), std::string::npos) << many;
}

TEST_F(ProjectFile, RefusesAlarmsThatAreNoNumbers) {
  for (const char* limit : {"1e999", "\"5\"", "null", "-1001", "[]"}) {
    const std::string said = refusal(with(savedText(), "\"limit_N\": -5", std::string("\"limit_N\": ") + limit));
    EXPECT_FALSE(said.empty()) << limit;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
  }
}

TEST_F(ProjectFile, ReadsTheCutOfAnOlderFile) {
  const std::string text = with(savedText(), "\"arrows\"", "\"clip_y_mm\": 7.25, \"arrows\"");
  std::ofstream(path("older.json")) << text;
  EXPECT_EQ(loadProject(path("older.json"), {}).view.cut, (CutPlane{1, 7.25}));
}

TEST_F(ProjectFile, RefusesCutsAndColoursThatCannotBeInOneLine) {
  for (const auto& [wrong, key] :
       {std::pair{"\"cut\": {\"axis\": \"w\", \"at_mm\": 1}", "axis"},
        std::pair{"\"cut\": {\"axis\": \"x\", \"at_mm\": -1}", "at_mm"},
        std::pair{"\"cut\": {\"axis\": \"x\"}", "at_mm"}, std::pair{"\"color_map\": \"jet\"", "viridis"},
        std::pair{"\"color_range\": [1, 1]", "color_range"}, std::pair{"\"extremes\": 1", "extremes"},
        std::pair{"\"less_kept\": 1", "less_kept"}}) {
    const std::string words = refusal(with(savedText(), "\"arrows\"", std::string(wrong) + ", \"arrows\""));
    EXPECT_NE(words.find(key), std::string::npos) << wrong << ": " << words;
    EXPECT_EQ(words.find('\n'), std::string::npos) << words;
  }
}

TEST_F(ProjectFile, RefusesAKeptDesignThatCannotBeBuiltInOneLine) {
  Project project = exampleProject();
  project.kept = paperDesign();
  const std::string text = projectText(project).toStdString();
  const std::size_t at = text.find("\"kept_design\"");
  ASSERT_NE(at, std::string::npos);
  const std::string words = refusal(text.substr(0, at) + with(text.substr(at), "0.5", "-0.5"));
  EXPECT_NE(words.find("kept_design"), std::string::npos) << words;
  EXPECT_EQ(words.find('\n'), std::string::npos) << words;
}

TEST_F(ProjectFile, ReadsADesignFileIntoTheOpenProject) {
  SensorDesign design = paperDesign();
  design.block_mm.z() = 6;
  saveDesign(path("sensor.json"), design, false);
  const Project project = loadProject(path("sensor.json"), exampleProject());
  EXPECT_EQ(project.design, design);
  EXPECT_EQ(project.load, exampleProject().load);
}

SensorDesign underTheField() {
  SensorDesign design = paperDesign();
  design.resistance = FieldLaw{1500, 0.15, 0.5, 4, Readout::RowsGrounded};
  design.pressureLaw = PressureLaw{0.1, 0.25};
  return design;
}

TEST_F(ProjectFile, KeepsTheFieldOfTheDesignAndOfTheKeptOne) {
  Project project = exampleProject();
  project.design = underTheField();
  project.kept = paperDesign();
  saveProject(path("field.json"), project);
  EXPECT_EQ(loadProject(path("field.json"), exampleProject()), project);
  std::swap(project.design, *project.kept);
  saveProject(path("kept.json"), project);
  EXPECT_EQ(loadProject(path("kept.json"), exampleProject()), project);
  saveDesign(path("sensor.json"), underTheField(), false);
  EXPECT_EQ(loadProject(path("sensor.json"), exampleProject()).design, underTheField());
}

TEST_F(ProjectFile, RefusesAFieldThatCannotBeInOneLine) {
  Project project = exampleProject();
  project.design = underTheField();
  const std::string text = QJsonDocument::fromJson(projectText(project)).toJson(QJsonDocument::Compact).toStdString();
  for (const auto& [from, to, words] :
       {std::tuple{"\"electrode_radius_mm\":0.15", "\"electrode_radius_mm\":0.6", "electrodes overlap"},
        std::tuple{"\"readout\":\"rows_grounded\"", "\"readout\":\"loud\"", "virtual_ground"},
        std::tuple{"\"wire_ohm\":4", "\"wire_ohm\":-4", "wire_ohm"}}) {
    const std::string sentence = refusal(with(text, from, to));
    EXPECT_NE(sentence.find(words), std::string::npos) << to << ": " << sentence;
    EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
  }
}

TEST_F(ProjectFile, DropsALoadThatCannotActOnTheOpenedDesign) {
  SensorDesign design = paperDesign();
  design.areas = {1, 1};
  saveDesign(path("sensor.json"), design, false);
  const Project project = loadProject(path("sensor.json"), exampleProject());
  EXPECT_FALSE(whyInvalid(project.load, project.design).has_value());
}

TEST_F(ProjectFile, IsRefusedWithASentenceWhereItIsFromANewerPalp) {
  const std::string sentence = refusal(with(savedText(), "\"palp_project\": 2", "\"palp_project\": 9"));
  EXPECT_NE(sentence.find("newer"), std::string::npos) << sentence;
}

TEST_F(ProjectFile, OfTheFirstVersionIsReadWithTheUsualView) {
  QJsonObject old = QJsonDocument::fromJson(QByteArray::fromStdString(savedText())).object();
  old["palp_project"] = 1;
  old.remove("view");
  std::ofstream(path("old.json")) << QJsonDocument(old).toJson().toStdString();
  EXPECT_EQ(loadProject(path("old.json"), exampleProject()), exampleProject());
}

TEST_F(ProjectFile, IsRefusedWithASentenceWhereItIsCutOff) {
  const std::string text = savedText();
  EXPECT_NE(refusal(text.substr(0, text.size() / 2)).find("not valid JSON"), std::string::npos);
}

TEST_F(ProjectFile, IsRefusedWithItsKeyWhereATypeIsWrong) {
  const std::string sentence = refusal(with(savedText(), "\"spread\": 1", "\"spread\": \"wide\""));
  EXPECT_NE(sentence.find("network.spread"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("wide"), std::string::npos) << sentence;
}

TEST_F(ProjectFile, IsRefusedWithItsKeyWhereItIsUnknown) {
  const std::string sentence = refusal(with(savedText(), "\"per_area\"", "\"per_areas\""));
  EXPECT_NE(sentence.find("per_area"), std::string::npos) << sentence;
}

TEST_F(ProjectFile, IsRefusedWhereAKeyStandsTwice) {
  const std::string twice = with(savedText(), "\"per_area\"", "\"per_area\": 7, \"per_area\"");
  EXPECT_NE(refusal(twice).find("\"per_area\" appears twice"), std::string::npos) << refusal(twice);
}

TEST_F(ProjectFile, IsRefusedWithFileAndKeyWhereItsDesignCannotBeBuilt) {
  const std::string sentence = refusal(with(savedText(), "\"poisson_ratio\": 0.499", "\"poisson_ratio\": 0.7"));
  EXPECT_NE(sentence.find("bad.json: design.material.poisson_ratio"), std::string::npos) << sentence;
}

TEST_F(ProjectFile, CutOffAnywhereIsRefusedAndNeverReadAsAnother) {
  const std::string text = savedText();
  const std::size_t end = text.find_last_of('}');
  for (std::size_t size = 0; size < end; size += 37) EXPECT_NE(refusal(text.substr(0, size)), "") << size;
}

TEST_F(ProjectFile, IsRefusedWithTheKeyWhateverTypeIsWrong) {
  const QJsonObject good = QJsonDocument::fromJson(QByteArray::fromStdString(savedText())).object();
  for (const QString& part : QStringList{"load", "mesh", "samples", "network", "view"}) {
    const QJsonObject inside = good[part].toObject();
    for (const QString& key : inside.keys()) {
      QJsonObject bad = good;
      QJsonObject changed = inside;
      changed[key] = QJsonObject{{"x", 1}};
      bad[part] = changed;
      const std::string sentence = refusal(QJsonDocument(bad).toJson().toStdString());
      EXPECT_NE(sentence.find((part + "." + key).toStdString()), std::string::npos) << key.toStdString() << sentence;
    }
  }
}

TEST_F(ProjectFile, NamesAFileThatIsNotThere) {
  EXPECT_THROW(loadProject(path("none.json"), exampleProject()), Error);
}

TEST(Command, SaysTheLoadAndTheMeshAsTheCommandLineReadsThem) {
  Project project = exampleProject();
  project.mesh.meshSize_mm = 2.5;
  EXPECT_EQ(solveCommands(project, "s.json"),
            "palp solve s.json --load 1:0.5,0.3,-6 --mesh-size 2.5 -o deformed.vtu\n"
            "palp render s.json --load 1:0.5,0.3,-6 --mesh-size 2.5 --quantity \"|u|\" -o deformed.png");
  EXPECT_TRUE(meshCommands(project, "s.json").contains("palp mesh s.json --mesh-size 2.5"));
  EXPECT_TRUE(networkCommands(project, "s.json").contains("--rows 4 --mode default"));
}

/// One frame of a board with 2 row-wires and 3 column-wires, and a network that decodes it.
LiveSettings calibratedBoard() {
  BoardFrames frames;
  frames.samples.origin.designFingerprint = "c0ef9caa8fec76b8";
  frames.samples.origin.mesh = "measured on a board";
  frames.samples.rowWires = 2;
  frames.samples.electrodesPerRowWire = 1;
  frames.samples.columnWires = 3;
  frames.samples.areaCount = 2;
  frames.samples.area = Eigen::VectorXi::Constant(2, 1);
  frames.samples.forces_N = Eigen::MatrixXd::Constant(3, 2, -0.1);
  frames.samples.resistances_ohm = Eigen::MatrixXd::Constant(6, 2, 100.0 / 3);
  frames.read_N = Eigen::Matrix3Xd::Constant(3, 2, 1.0 / 3);
  frames.read_N.col(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  LiveSettings live;
  live.frames = std::make_shared<const BoardFrames>(frames);
  live.calibrated = std::make_shared<const CalibratedNetwork>(
      CalibratedNetwork{readNetwork(resource("board/paper-network.json")), "calibrated, 2 frames"});
  return live;
}

TEST_F(ProjectFile, KeepsLabelledFramesAndTheCalibratedNetworkOfEachBoard) {
  Project project = exampleProject();
  project.live = calibratedBoard();
  project.moreBoards = {LiveSettings(), calibratedBoard()};
  const Project again = parseProject(projectText(project), "x.json", {});
  for (const std::size_t board : {0, 2}) {
    const LiveSettings& live = again.board(board);
    ASSERT_NE(live.frames, nullptr);
    EXPECT_EQ(samplesText(live.frames->samples), samplesText(project.live.frames->samples));
    EXPECT_EQ(live.frames->read_N.col(0), project.live.frames->read_N.col(0));
    EXPECT_TRUE(live.frames->read_N.col(1).hasNaN());
    ASSERT_NE(live.calibrated, nullptr);
    EXPECT_EQ(live.calibrated->name, "calibrated, 2 frames");
    EXPECT_EQ(networkText(live.calibrated->decoder), networkText(project.live.calibrated->decoder)) << "to the bit";
  }
  EXPECT_EQ(again.board(1).frames, nullptr);
  EXPECT_FALSE(projectText(exampleProject()).contains("calibration")) << "older versions read such projects";
}

TEST_F(ProjectFile, ADesignAloneTakesNoCalibrationOfTheProjectThatIsLeft) {
  Project before = exampleProject();
  before.live = calibratedBoard();
  const Project next = parseProject(QByteArray::fromStdString(toJson(paperDesign())), "design.json", before);
  EXPECT_EQ(next.live.frames, nullptr);
  EXPECT_EQ(next.live.calibrated, nullptr);
}

TEST_F(ProjectFile, RefusesABrokenCalibrationByItsPlace) {
  Project project = exampleProject();
  project.live = calibratedBoard();
  const std::string text = projectText(project).toStdString();
  EXPECT_NE(refusal(with(text, "33.33333333", "33.3x")).find("live.calibration.frames"), std::string::npos);
  EXPECT_NE(refusal(with(text, "\"noise_relative\"", "\"noise\"")).find("live.calibration.network"), std::string::npos);
}

} // namespace
} // namespace palp
