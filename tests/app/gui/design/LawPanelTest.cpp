#include "app/gui/design/BoundWords.h"
#include "app/gui/design/RestFloor.h"
#include "app/gui/views/HeatmapView.h"
#include "tests/app/gui/WindowFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTabWidget>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// The law of the resistances by mouse and keys on the Design scene, and what the other scenes make of it.
class LawPanelTest : public WindowFixture {
protected:
  LawPanelTest() {
    window.showScene("design");
    settle();
  }
  void type(const char* field, const QString& words) {
    auto& edit = find<QLineEdit>(field);
    edit.setFocus();
    edit.selectAll();
    QTest::keyClicks(&edit, words);
    settle();
  }
  void choose(const char* field, Qt::Key key) {
    auto& box = find<QComboBox>(field);
    box.setFocus();
    QTest::keyClick(&box, key);
    settle();
  }
  void chooseField() { choose("resistance.law", Qt::Key_Down); }
  QString problemAt(const char* field) {
    auto& label = find<QLabel>((std::string(field) + " problem").c_str());
    return label.isVisible() ? label.text() : QString();
  }
  /// No part of the panel lies over another one.
  void expectApart() {
    const QList<QWidget*> parts =
        find<QComboBox>("resistance.law").parentWidget()->findChildren<QWidget*>(QString(), Qt::FindDirectChildrenOnly);
    for (const QWidget* a : parts)
      for (const QWidget* b : parts) {
        if (a == b || !a->isVisible() || !b->isVisible()) continue;
        EXPECT_FALSE(a->geometry().intersects(b->geometry()))
            << a->objectName().toStdString() << " and " << b->objectName().toStdString();
      }
  }
  const FieldLaw* field() { return workbench.project().design.field(); }
  QString floorWords() { return find<QLabel>("noiseFloor").text(); }
  bool bounded() {
    return QTest::qWaitFor([&] { return floorWords().contains("Cramer-Rao") && !window.busy(); }, kPatience_ms);
  }
};

TEST_F(LawPanelTest, ALawIsChosenByKeysWithItsOwnNumbersAndUndoneByItsName) {
  type("resistance.rate_ohm_per_mm", "900");
  EXPECT_TRUE(find<QLineEdit>("resistance.electrode_radius_mm").isHidden());
  chooseField();
  ASSERT_NE(field(), nullptr);
  EXPECT_EQ(*field(), FieldLaw{});
  expectApart();
  EXPECT_TRUE(find<QLineEdit>("resistance.rate_ohm_per_mm").isHidden());
  EXPECT_TRUE(find<QLineEdit>("resistance.electrode_radius_mm").isVisible());
  EXPECT_EQ(workbench.history().undoText(), "resistance law Eq. (1), independent pairs -> conduction field");
  type("resistance.electrode_radius_mm", "0.25");
  EXPECT_EQ(field()->electrodeRadius_mm, 0.25);
  EXPECT_EQ(workbench.history().undoText(), "resistance electrode radius 0.2 -> 0.25 mm");
  choose("resistance.law", Qt::Key_Up);
  EXPECT_EQ(workbench.project().design.resistance, ResistanceLaw(PairsLaw{900})) << "as it was typed before";
  chooseField();
  EXPECT_EQ(field()->electrodeRadius_mm, 0.25) << "the numbers wait for their law";
  while (workbench.history().canUndo()) workbench.history().undo();
  EXPECT_EQ(workbench.project().design, paperDesign());
  EXPECT_EQ(find<QComboBox>("resistance.law").currentIndex(), 0);
}

TEST_F(LawPanelTest, EveryNumberOfTheFieldIsCheckedAtItself) {
  chooseField();
  const std::vector<std::array<const char*, 4>> slips{
      {"resistance.resistivity_ohm_mm", "0", "expected 1e-06 to", "2000 ohm mm"},
      {"resistance.electrode_radius_mm", "0.6", "electrodes overlap", "0.2 mm"},
      {"resistance.contact_ohm_mm2", "-1", "expected 0 up to", "0 ohm mm2"},
      {"resistance.wire_ohm", "ohm", "not a number", "0 ohm"}};
  for (const auto& [key, wrong, sentence, inUse] : slips) {
    const QString before = find<QLineEdit>(key).text();
    type(key, wrong);
    EXPECT_EQ(*field(), FieldLaw{}) << key;
    EXPECT_TRUE(problemAt(key).contains(sentence)) << problemAt(key).toStdString();
    EXPECT_TRUE(problemAt(key).contains(QString("The design still has ") + inUse)) << problemAt(key).toStdString();
    EXPECT_TRUE(find<QLineEdit>(key).property("wrong").toBool()) << key;
    type(key, before);
    EXPECT_EQ(problemAt(key), QString()) << key;
  }
}

TEST_F(LawPanelTest, ARadiusThatIsLargeForItsGapIsWarnedOfWithItsErrorAndTaken) {
  chooseField();
  auto& warning = find<QLabel>("lawWarning");
  EXPECT_FALSE(warning.isVisible());
  type("resistance.electrode_radius_mm", "0.4");
  EXPECT_EQ(field()->electrodeRadius_mm, 0.4);
  EXPECT_TRUE(warning.isVisible());
  EXPECT_TRUE(warning.text().contains("0.4 mm is 0.4 of the gap")) << warning.text().toStdString();
  EXPECT_TRUE(warning.text().contains("its error is about")) << warning.text().toStdString();
  EXPECT_EQ(problemAt("resistance.electrode_radius_mm"), QString());
  type("resistance.electrode_radius_mm", "0.3");
  EXPECT_FALSE(warning.isVisible());
}

TEST_F(LawPanelTest, AReadoutIsSaidAsTheCircuitThatReads) {
  chooseField();
  const QString floating = find<QLabel>("readoutWords").text();
  EXPECT_TRUE(floating.contains("wires float")) << floating.toStdString();
  choose("resistance.readout", Qt::Key_Down);
  EXPECT_EQ(field()->readout, Readout::VirtualGround);
  EXPECT_TRUE(find<QLabel>("readoutWords").text().contains("0 V"));
  EXPECT_EQ(workbench.history().undoText(), "resistance read-out floating -> virtual ground");
  for (const Readout next : {Readout::RowsGrounded, Readout::OthersAtHalf}) {
    choose("resistance.readout", Qt::Key_Down);
    EXPECT_EQ(field()->readout, next);
  }
}

TEST_F(LawPanelTest, ALawThatTheDesignCannotHaveSaysWhereAndComesWithTheNumberThatFits) {
  type("lower_layer.electrode_y_mm", "5, 5.3, 25"); // nearer than two radii
  ASSERT_EQ(problemAt("lower_layer.electrode_y_mm"), QString());
  chooseField();
  EXPECT_EQ(field(), nullptr);
  const QString problem = problemAt("resistance.electrode_radius_mm");
  EXPECT_TRUE(problem.contains("electrodes overlap")) << problem.toStdString();
  EXPECT_TRUE(problem.contains("The design still has Eq. (1)")) << problem.toStdString();
  EXPECT_TRUE(problemAt("resistance.law").contains("The design still has Eq. (1)"))
      << problemAt("resistance.law").toStdString();
  QTest::keyClick(&find<QComboBox>("resistance.law"), Qt::Key_Z, Qt::ControlModifier);
  settle();
  EXPECT_EQ(find<QComboBox>("resistance.law").currentIndex(), 0) << "what was not applied goes first";
  EXPECT_EQ(workbench.project().design.lower.along_mm[0][1], 5.3);
  chooseField();
  type("resistance.electrode_radius_mm", "0.1");
  ASSERT_NE(field(), nullptr);
  EXPECT_EQ(field()->electrodeRadius_mm, 0.1);
  EXPECT_EQ(problemAt("resistance.law"), QString());
}

TEST_F(LawPanelTest, ThePressureLawHoldsUnderEitherLawAndItsNumbersAreChecked) {
  chooseField();
  QTest::mouseClick(&find<QCheckBox>("pressureLaw"), Qt::LeftButton, {}, {8, 8});
  EXPECT_EQ(workbench.project().design.pressureLaw, PressureLaw{});
  EXPECT_NE(field(), nullptr);
  type("p0", "soft");
  bool said = false;
  for (const QLabel* label : window.currentScene().findChildren<QLabel*>())
    said = said || (label->isVisible() && label->text().contains("\"soft\" is not a number"));
  EXPECT_TRUE(said);
  EXPECT_EQ(workbench.project().design.pressureLaw, PressureLaw{});
  type("p0", "0.1");
  EXPECT_EQ(workbench.project().design.pressureLaw->p0_MPa, 0.1);
}

TEST_F(LawPanelTest, TheNoiseFloorOfTheFieldStandsForEveryReadoutBesideEq1AndNeedsNoSamples) {
  EXPECT_TRUE(floorWords().contains("samples")) << floorWords().toStdString();
  chooseField();
  ASSERT_TRUE(bounded()) << floorWords().toStdString();
  EXPECT_FALSE(find<QPushButton>("floorSamples").isVisible());
  const Project& project = workbench.project();
  StageLog stages;
  const auto block = AreaResponse::atRest(project.design, project.mesh, 0, stages, {}, {});
  const FieldResponse response(project.design, *project.design.field(), *block, 0);
  for (const auto& [readout, name] : kReadouts.all()) {
    const QString all = boundPercents(response.bound(readout, -1, project.view.resistanceNoise).withPrior())
                            .replace(' ', "&nbsp;"); // in one line
    EXPECT_TRUE(floorWords().contains(all)) << name << " " << all.toStdString() << floorWords().toStdString();
  }
  EXPECT_TRUE(floorWords().contains("Eq.&nbsp;(1)&nbsp;for&nbsp;comparison"));
  EXPECT_TRUE(floorWords().contains("<b>floating</b>"));
  choose("resistance.readout", Qt::Key_Down);
  EXPECT_FALSE(window.busy()) << "all read-outs were bounded at once";
  EXPECT_TRUE(floorWords().contains("<b>virtual&nbsp;ground</b>")) << floorWords().toStdString();
  const QString before = floorWords();
  find<QDoubleSpinBox>("resistanceNoise").setValue(1);
  EXPECT_FALSE(floorWords().contains("Cramer-Rao")) << "the bound of another noise stays";
  ASSERT_TRUE(bounded());
  EXPECT_NE(floorWords(), before);
  workbench.history().undo(); // the read-out
  workbench.history().undo(); // the law
  ASSERT_EQ(workbench.project().design, paperDesign());
  EXPECT_TRUE(floorWords().contains("Available once there are samples")) << floorWords().toStdString();
}

TEST_F(LawPanelTest, ABoundOfTheFieldThatIsStoppedSaysSoAndTheNextEditComputesIt) {
  chooseField();
  ASSERT_TRUE(window.busy());
  QTest::keyClick(&window, Qt::Key_Escape);
  ASSERT_TRUE(idle());
  EXPECT_TRUE(floorWords().contains("Cancelled")) << floorWords().toStdString();
  type("resistance.wire_ohm", "5");
  EXPECT_TRUE(bounded()) << floorWords().toStdString();
}

TEST_F(LawPanelTest, NoBoundIsComputedWhereNobodyLooks) {
  window.showScene("reports");
  Project next = workbench.project();
  next.design.resistance = FieldLaw{};
  workbench.edit("field", next);
  settle();
  EXPECT_FALSE(window.busy());
  window.showScene("design");
  EXPECT_TRUE(bounded()) << floorWords().toStdString();
}

TEST_F(LawPanelTest, ABoundOfTheFieldThatEndsAfterTheLawWentBackToEq1IsNotShown) {
  chooseField();
  ASSERT_TRUE(window.busy());
  window.showScene("network"); // the Design scene is not brought up to date where nobody looks
  Project next = workbench.project();
  next.design.resistance = PairsLaw{};
  workbench.edit("Eq. (1)", next);
  ASSERT_TRUE(idle());
  window.showScene("design");
  settle();
  EXPECT_TRUE(floorWords().contains("Available once there are samples")) << floorWords().toStdString();
  chooseField();
  EXPECT_TRUE(bounded()) << floorWords().toStdString();
}

TEST_F(LawPanelTest, EverySceneFollowsTheFieldAndComesBackWithEq1) {
  chooseField();
  find<QTabWidget>("designTabs").setCurrentIndex(1);
  settle();
  EXPECT_TRUE(find<QPushButton>("findLayout").isEnabled());
  window.showScene("network");
  EXPECT_TRUE(find<QPushButton>("generate").isEnabled());
  window.showScene("deformation");
  ASSERT_TRUE(solved());
  const auto map = [&]() -> const Eigen::MatrixXd& { return find<HeatmapView>("heatmap").heatmap().values; };
  ASSERT_TRUE(QTest::qWaitFor([&] { return map().rows() == 10; }, kPatience_ms));
  const Eigen::MatrixXd underField = map();
  window.showScene("design");
  choose("resistance.law", Qt::Key_Up);
  EXPECT_TRUE(find<QPushButton>("generate").isEnabled());
  window.showScene("deformation");
  ASSERT_TRUE(solved());
  EXPECT_TRUE(QTest::qWaitFor([&] { return map().rows() == 10 && map() != underField; }, kPatience_ms));
}

} // namespace
} // namespace palp
