#include "app/gui/design/DesignFields.h"
#include "tests/app/gui/WindowFixture.h"

#include <QAbstractButton>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>

namespace palp {
namespace {

class DesignPageTest : public WindowFixture {};

TEST(DesignFields, WriteEvenlySpacedPlacesInShortAndReadThemBackExactly) {
  const auto field = std::find_if(designFields().begin(), designFields().end(),
                                  [](const DesignField& each) { return each.key == "lower_layer.column_wire_x_mm"; });
  ASSERT_NE(field, designFields().end());
  SensorDesign design = paperDesign();
  EXPECT_EQ(field->text(design), "0.5, 1.5, ..., 29.5");
  SensorDesign again = design;
  again.lower.wire_mm = {1};
  EXPECT_EQ(field->set(again, field->text(design)), QString());
  EXPECT_EQ(again.lower.wire_mm, design.lower.wire_mm);
  design.lower.wire_mm[7] += 0.25;
  EXPECT_EQ(field->text(design).count(','), 29) << "what is not evenly spaced is written out";
  EXPECT_EQ(field->set(again, "1, 2, ..., 5, 7"), QString());
  EXPECT_EQ(again.lower.wire_mm, (std::vector<double>{1, 2, 3, 4, 5, 7}));
  for (const char* wrong : {"...", "1, ..., 5", "1, 2, ...", "1, 2, ..., 4.5", "1, 2, ..., 2", "1, 1, ..., 5",
                            "0, 1e-9, ..., 30", "5, 4, ..., 9", "1, 2, ..., x", "1, 2, ..., nan"})
    EXPECT_NE(field->set(again, wrong), QString()) << wrong;
}

TEST_F(DesignPageTest, LooksAtTheDesignWithoutAMeshAndAtTheMeshWithoutASolve) {
  Workbench fresh(quickProject());
  NetworkSession noNetwork;
  MainWindow other(fresh, noNetwork);
  other.showScene("design");
  other.show();
  settle();
  EXPECT_TRUE(fresh.touch().stages().counts().empty());
  const int solves = 0;
  Project changed = fresh.project();
  changed.design.block_mm.z() = 6;
  fresh.edit("height", changed);
  settle();
  EXPECT_FALSE(fresh.touch().runner().running());
  EXPECT_EQ(fresh.touch().stages().runs("solve"), solves);
  auto* showMesh = other.findChild<QAbstractButton*>("showMesh");
  showMesh->click();
  ASSERT_TRUE(QTest::qWaitFor([&] { return fresh.touch().upToDate() && fresh.touch().touch().mesh() != nullptr; },
                              kPatience_ms));
  EXPECT_EQ(fresh.touch().touch().reached(), Stage::Mesh);
  EXPECT_EQ(fresh.touch().stages().runs("solve"), solves);
}

TEST_F(DesignPageTest, ShowsAProjectsOwnNumbersAndKeepsThemWhenOthersAreEdited) {
  window.showScene("design");
  Project project = workbench.project();
  project.mesh = {0.333, {}}; // finer than the box offers, and with more digits
  project.view.resistanceNoise = 5e-7;
  project.network.noise = 2.5e-8;
  project.network.chosenSpread = 0.0012345;
  project.network.automaticSpread = false;
  workbench.replace(project);
  EXPECT_EQ(find<QDoubleSpinBox>("meshSize").value(), 0.333);
  EXPECT_NEAR(find<QDoubleSpinBox>("resistanceNoise").value(), 5e-5, 1e-18);
  EXPECT_EQ(find<QDoubleSpinBox>("spread").value(), 0.0012345);
  // The panel hands over all of its boxes: one that showed another number would change the project.
  window.showScene("network");
  find<QSpinBox>("centers").setValue(17);
  EXPECT_EQ(workbench.project().network.centers, 17);
  EXPECT_NEAR(workbench.project().network.noise, 2.5e-8, 1e-22) << "a factor of 100 there and back";
  EXPECT_EQ(workbench.project().network.chosenSpread, 0.0012345);
  EXPECT_EQ(workbench.project().mesh.meshSize_mm, 0.333);
}

TEST_F(DesignPageTest, MeasuresTheMeshAndTheNoiseFloorOffTheWindowsThreadAndOnlyWhileSeen) {
  ASSERT_TRUE(solved());
  network.setDesign(workbench.project().design);
  network.generate(workbench.project().samples, workbench.project().mesh);
  ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
  auto& words = find<QLabel>("meshWords");
  auto& floor = find<QLabel>("noiseFloor");
  Project next = workbench.project();
  next.view.mesh = true;
  workbench.edit("mesh", next); // not seen: nothing is measured
  EXPECT_FALSE(window.busy());
  EXPECT_FALSE(words.text().contains("dihedral")) << words.text().toStdString();
  EXPECT_FALSE(floor.text().contains("Cramer-Rao"));
  window.showScene("design");
  EXPECT_FALSE(floor.text().contains("Cramer-Rao")) << "computed while the window waited";
  ASSERT_TRUE(QTest::qWaitFor([&] { return words.text().contains("dihedral") && floor.text().contains("Cramer-Rao"); },
                              kPatience_ms));
  find<QDoubleSpinBox>("resistanceNoise").setValue(1);
  EXPECT_FALSE(floor.text().contains("Cramer-Rao")) << "the bound of another noise stays";
  EXPECT_TRUE(QTest::qWaitFor([&] { return floor.text().contains("Cramer-Rao"); }, kPatience_ms));
}

TEST_F(DesignPageTest, TakesAPreset) {
  window.showScene("design");
  auto& presets = find<QComboBox>("presets");
  emit presets.activated(2);
  EXPECT_EQ(workbench.project().design.material.poissonRatio, 0.5);
  workbench.history().undo();
  EXPECT_EQ(workbench.project().design, paperDesign());
}

TEST_F(DesignPageTest, ExplainsAWrongValueInPlaceAndKeepsTheDesign) {
  window.showScene("design");
  auto& ratio = find<QLineEdit>("material.poisson_ratio");
  ratio.setFocus();
  ratio.selectAll();
  QTest::keyClicks(&ratio, "7");
  EXPECT_EQ(workbench.project().design, paperDesign());
  bool explained = false;
  for (const QLabel* label : window.currentScene().findChildren<QLabel*>())
    explained = explained || (label->isVisible() && label->text().contains("0 to 0.5"));
  EXPECT_TRUE(explained);
  ratio.selectAll();
  QTest::keyClicks(&ratio, "0.49");
  EXPECT_EQ(workbench.project().design.material.poissonRatio, 0.49);
}

} // namespace
} // namespace palp
