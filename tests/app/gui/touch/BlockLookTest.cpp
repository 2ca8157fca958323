#include "app/gui/jobs/LoadPath.h"
#include "app/gui/views/BlockView.h"
#include "app/scenes/block/DeformationPicture.h"
#include "app/scenes/charts/TextStyle.h"
#include "solver/SensorMesh.h"
#include "tests/app/gui/WindowFixture.h"

#include <Eigen/Geometry>

#include <vtkCamera.h>

#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QSlider>

#include <gtest/gtest.h>

#include <cmath>

namespace palp {
namespace {

class BlockLook : public WindowFixture {
protected:
  BlockView& block() { return find<BlockView>("block"); }
  /// Solved, drawn, and nothing more to come.
  bool drawn() {
    const bool there = solved() && idle();
    settle();
    static_cast<void>(block().image());
    return there;
  }
  void press(const char* button, const QKeySequence& key, const std::function<bool()>& done) {
    const QKeyCombination keys = key[0];
    QTest::keyClick(&window, keys.key(), keys.keyboardModifiers());
    EXPECT_TRUE(QTest::qWaitFor(done, kPatience_ms)) << button;
  }
  void onPlace(std::function<void()> look) {
    QObject::connect(&workbench.touch(), &TouchSession::changed, &window, [look = std::move(look)](bool) { look(); });
  }
  Eigen::Vector3d lookDirection() {
    std::array<double, 3> direction{};
    block().camera()->GetDirectionOfProjection(direction.data());
    return Eigen::Vector3d(direction.data());
  }
  Eigen::Vector3d up() {
    std::array<double, 3> direction{};
    block().camera()->GetViewUp(direction.data());
    return Eigen::Vector3d(direction.data());
  }
};

TEST_F(BlockLook, TheBlockKeepsClearOfItsLegendWhateverItSays) {
  window.resize(1272, 764); // a screen of 1280 x 800
  ASSERT_TRUE(drawn());
  auto& quantity = find<QComboBox>("quantity");
  for (int k = 0; k < quantity.count(); ++k) {
    quantity.setCurrentIndex(k);
    static_cast<void>(block().image());
    const Quantity shown = workbench.project().view.quantity;
    const std::string title =
        quantityName(shown) + (quantityUnit(shown).empty() ? "" : " [" + quantityUnit(shown) + "]");
    const double legend_px = textWidth_px(title, 13, true) + 14;
    const Eigen::Vector3d size_mm = workbench.project().design.block_mm;
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3d place_mm = size_mm.cwiseProduct(Eigen::Vector3d(corner & 1, corner >> 1 & 1, corner >> 2));
      EXPECT_LE(block().placeOf(place_mm).x(), block().width() - legend_px) << title << ", corner " << corner;
    }
  }
}

TEST_F(BlockLook, LooksFromEverySideByKeysAndComesHome) {
  ASSERT_TRUE(drawn());
  const Eigen::Vector3d home = lookDirection();
  const std::array<std::pair<QKeySequence, Eigen::Vector3d>, 6> sides{{{Qt::Key_X, {-1, 0, 0}},
                                                                       {Qt::SHIFT | Qt::Key_X, {1, 0, 0}},
                                                                       {Qt::Key_Y, {0, -1, 0}},
                                                                       {Qt::SHIFT | Qt::Key_Y, {0, 1, 0}},
                                                                       {Qt::Key_Z, {0, 0, -1}},
                                                                       {Qt::SHIFT | Qt::Key_Z, {0, 0, 1}}}};
  for (const auto& [key, along] : sides) {
    press("side", key, [&] { return lookDirection().dot(along) > 1 - 1e-9; });
    EXPECT_NEAR(up().norm(), 1, 1e-9);
    EXPECT_NEAR(up().dot(along), 0, 1e-9);
    QTest::qWait(120); // the button is released
  }
  press("home", Qt::Key_H, [&] { return lookDirection().dot(home) > 1 - 1e-9; });
}

TEST_F(BlockLook, UpStaysUpHoweverItIsTurned) {
  ASSERT_TRUE(drawn());
  const QPoint middle = block().rect().center();
  for (const QPoint& way : {QPoint(150, 60), QPoint(-220, 90), QPoint(40, -300), QPoint(90, 500), QPoint(-130, -70)}) {
    drag(block(), middle + QPoint(-200, 60), middle + QPoint(-200, 60) + way); // beside the arrow
    EXPECT_GE(up().z(), -1e-9);
    EXPECT_NEAR(up().cross(lookDirection()).z(), 0, 1e-6) << "the horizon is level";
  }
}

TEST_F(BlockLook, KeepsTheLegendsRangeWhileTheLoadChanges) {
  ASSERT_TRUE(drawn());
  const auto fitting = block().colorRange();
  EXPECT_NEAR(find<QDoubleSpinBox>("rangeTo").value(), fitting[1], 1e-3 * fitting[1]);
  find<QCheckBox>("keepRange").click();
  auto& to = find<QDoubleSpinBox>("rangeTo");
  to.setFocus();
  to.selectAll();
  QTest::keyClicks(&to, "2.5");
  QTest::keyClick(&to, Qt::Key_Return);
  Project stronger = workbench.project();
  stronger.load.areas[0].force_N *= 0.5;
  workbench.edit("half", stronger);
  ASSERT_TRUE(drawn());
  EXPECT_EQ(block().colorRange()[1], 2.5);
  EXPECT_FALSE(workbench.history().undoText().contains("legend"));
  auto& quantity = find<QComboBox>("quantity");
  quantity.setCurrentIndex(quantity.findText("stress zz [MPa]"));
  EXPECT_FALSE(find<QCheckBox>("keepRange").isChecked()) << "2.5 mm say nothing of MPa";
  EXPECT_EQ(workbench.project().view.quantity, Quantity::StressZZ);
}

TEST_F(BlockLook, AtRestTheLegendIsThatOfTheFullLoad) {
  ASSERT_TRUE(drawn());
  find<QComboBox>("quantity").setCurrentIndex(1); // ux: of both signs
  settle();
  const auto full = block().colorRange();
  find<QSlider>("increments").setValue(0);
  ASSERT_TRUE(QTest::qWaitFor([&] { return workbench.touch().place() == 0; }, kPatience_ms));
  settle();
  EXPECT_EQ(block().colorRange(), full) << "and not -1 to 1";
}

TEST_F(BlockLook, CutsAcrossEveryAxisAndDragsTheCutByItsKnob) {
  ASSERT_TRUE(drawn());
  auto& cut = find<QComboBox>("cut");
  const auto camera = block().cameraPosition();
  for (int axis = 0; axis < 3; ++axis) {
    cut.setCurrentIndex(axis + 1);
    settle();
    static_cast<void>(block().image());
    const double before = workbench.project().view.cut->at_mm;
    EXPECT_EQ(before, 0.5 * paperDesign().block_mm[axis]);
    CutPlane wanted{axis, 0.8 * paperDesign().block_mm[axis]};
    const auto grip = block().cutGrip();
    ASSERT_TRUE(grip.has_value());
    drag(block(), grip->toPoint(), block().placeOf(wanted.grip_mm(paperDesign().block_mm)).toPoint());
    EXPECT_NEAR(workbench.project().view.cut->at_mm, wanted.at_mm, 0.1 * paperDesign().block_mm[axis]) << axis;
    EXPECT_EQ(find<QDoubleSpinBox>("cutAt").value(), workbench.project().view.cut->at_mm);
  }
  EXPECT_EQ(block().cameraPosition(), camera) << "the block was not turned by it";
  EXPECT_FALSE(workbench.history().canUndo()) << "how it is shown stands in no history";
  cut.setCurrentIndex(0);
  EXPECT_FALSE(workbench.project().view.cut.has_value());
}

TEST_F(BlockLook, HidesArrowsOfForcesThatStandOnWhatIsCutAway) {
  ASSERT_TRUE(drawn());
  ASSERT_TRUE(block().gripOf(0).has_value());
  ViewSettings view = workbench.project().view;
  view.cut = CutPlane{1, 20}; // area 1 lies before it
  Project next = workbench.project();
  next.view = view;
  workbench.edit("cut", next);
  settle();
  EXPECT_FALSE(block().gripOf(0).has_value());
}

TEST_F(BlockLook, PlaysTheLoadPathOnceAndInALoop) {
  ASSERT_TRUE(drawn());
  TouchSession& touch = workbench.touch();
  auto& play = find<QAbstractButton>("playPath");
  const double largest = touch.fields()->displacement_mm.cwiseAbs().maxCoeff();
  bool between = false;
  onPlace([&] {
    between = between || (touch.place() > 20 && touch.place() < 80 &&
                          touch.fields()->displacement_mm.cwiseAbs().maxCoeff() < largest);
  });
  play.click();
  EXPECT_TRUE(QTest::qWaitFor([&] { return !play.isChecked(); }, kPatience_ms)) << "it ends by itself";
  EXPECT_EQ(touch.place(), 100);
  EXPECT_TRUE(between);
  find<QCheckBox>("loopPath").click();
  play.click();
  int starts = 0;
  onPlace([&] { starts += touch.place() == 0 ? 1 : 0; });
  EXPECT_TRUE(QTest::qWaitFor([&] { return starts >= 2; }, kPatience_ms));
  EXPECT_TRUE(play.isChecked());
  window.showScene("network");
  EXPECT_FALSE(play.isChecked()) << "what is not seen does not play";
  EXPECT_EQ(touch.stages().runs("solve"), 1) << "nothing is solved again";
}

TEST_F(BlockLook, SaysTheReactionBesideTheLoadAndWhereTheLargestDisplacementIs) {
  ASSERT_TRUE(drawn());
  const Eigen::Vector3d off =
      workbench.touch().touch().solution()->reaction_N + workbench.project().load.totalForce_N();
  EXPECT_LT(off.norm(), 1e-6);
  const QString words = find<QLabel>("result").text();
  EXPECT_TRUE(words.contains("reaction at the bottom (-0.5, -0.3, 6) N")) << words.toStdString();
  EXPECT_TRUE(words.contains(" mm at (")) << words.toStdString();
}

TEST(LoadPathStates, IsLinearBetweenItsEquilibriaAndEndsAtThem) {
  Touch touch(paperDesign(), exampleProject().load, {.meshSize_mm = {}, .mapped = std::array{6, 6, 2}, .discs = {}});
  ASSERT_TRUE(touch.advance(Stage::Resistances));
  const std::vector<LoadPathState> path = loadPathStates(touch, {});
  ASSERT_GE(path.size(), 2u);
  EXPECT_EQ(stateAt(path, 0).fields.displacement_mm.cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(stateAt(path, 1).fields.displacement_mm, path.back().fields.displacement_mm);
  const double t = 0.5 * (path[0].fraction + path[1].fraction);
  EXPECT_TRUE(stateAt(path, t).fields.displacement_mm.isApprox(0.5 * path[1].fields.displacement_mm, 1e-12));
  EXPECT_TRUE(stateAt(path, t).electrodes.upper_mm.isApprox(0.5 * path[1].electrodes.upper_mm, 1e-12));
}

/// How many pixels have a colour, within rounding.
int pixelsOf(const Picture& picture, const Color& color) {
  int count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const std::uint8_t* pixel = &picture.rgb[3 * (static_cast<std::size_t>(y) * picture.width + x)];
      bool same = true;
      for (std::size_t c = 0; c < 3; ++c) same = same && std::abs(pixel[c] - 255 * color[c]) <= 2;
      count += same ? 1 : 0;
    }
  return count;
}

/// A block whose fields are given by their shape, to be drawn without a solve.
struct ShapedBlock {
  SensorDesign design = paperDesign();
  Mesh mesh;
  NodalFields fields;
  explicit ShapedBlock(std::array<int, 3> cells) {
    MeshOptions coarse;
    coarse.mapped = cells;
    mesh = sensorMesh(design, coarse);
    fields.displacement_mm.setZero(3, mesh.nodeCount());
  }
  DeformationState state() const {
    DeformationState state;
    state.design = &design;
    state.mesh = &mesh;
    state.fields = &fields;
    return state;
  }
};

/// Displacement along x from 0 to 0.12 mm, without edges and outlines.
DeformationOptions plainColours() {
  DeformationOptions options;
  options.quantity = Quantity::DisplacementX;
  options.fixedRange = {0, 0.12};
  options.meshEdges = options.areaOutlines = false;
  return options;
}

TEST(BlockColours, AreThoseOfTheLegendThoughElectrodesShowThrough) {
  ShapedBlock block({6, 6, 2});
  block.fields.displacement_mm.row(0).setConstant(0.1); // one value everywhere
  for (const Theme theme : {Theme::Light, Theme::Dark})
    for (const bool electrodes : {true, false}) {
      DeformationOptions options = plainColours();
      options.electrodes = electrodes;
      options.theme = theme;
      const Picture picture = drawDeformation(block.state(), options, 480, 320);
      ColorScale legend{ColorMap::Diverging, 0, 0.12, "ux", "mm"};
      legend.opacity = electrodes ? options.opacity : 1;
      legend.ground = palette(theme).ground;
      EXPECT_GT(pixelsOf(picture, legend.shown(0.1)), 480 * 320 / 20) << "electrodes " << electrodes;
    }
}

TEST(BlockWords, KeepClearOfTheLegendInALowView) {
  ShapedBlock block({4, 4, 2});
  block.fields.displacement_mm.row(2) = -0.01 * block.mesh.nodes_mm.row(2);
  constexpr int kWidth = 400, kHeight = 290; // as the block of the Resistance scene on a small screen
  const Picture picture = drawDeformation(block.state(), plainColours(), kWidth, kHeight);
  const auto left = static_cast<int>(kWidth - 14 - textWidth_px("ux [mm]", 13, true));
  const auto middle = static_cast<int>((1 - 0.55) / 2 * kHeight - 18); // of the legend's title, from the top
  const auto pixel = [&](int x, int y) { return &picture.rgb[3 * static_cast<std::size_t>(y * kWidth + x)]; };
  for (int y = middle - 9; y < middle + 9; ++y)
    for (int x = left - 10; x < left - 2; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_EQ(pixel(x, y)[c], pixel(kWidth / 2, kHeight - 2)[c]) << x << ", " << y;
}

} // namespace
} // namespace palp
