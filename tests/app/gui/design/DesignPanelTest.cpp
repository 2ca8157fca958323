#include "app/gui/design/DesignPanel.h"

#include "app/gui/design/WireScaling.h"
#include "tests/app/gui/WindowFixture.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QLocale>
#include <QScrollArea>

#include <gtest/gtest.h>

namespace palp {
namespace {

class DesignPanelTest : public WindowFixture {
protected:
  DesignPanelTest() { window.showScene("design"); }
  void type(const char* field, const QString& words) {
    auto& edit = find<QLineEdit>(field);
    edit.setFocus();
    edit.selectAll();
    QTest::keyClicks(&edit, words);
    settle();
  }
  QString problemAt(const char* field) {
    auto& label = find<QLabel>((std::string(field) + " problem").c_str());
    return label.isVisible() ? label.text() : QString();
  }
  /// What lies over what in the panel; empty where everything has its own place and its whole height.
  QString overlaps() {
    QWidget& panel = find<DesignPanel>("designPanel");
    QList<QWidget*> parts;
    for (QWidget* part : panel.findChildren<QWidget*>())
      if (part->isVisible() && (qobject_cast<QLineEdit*>(part) != nullptr || qobject_cast<QLabel*>(part) != nullptr))
        parts << part;
    const auto place = [&](QWidget* part) { return QRect(part->mapTo(&panel, QPoint()), part->size()); };
    for (int a = 0; a < parts.size(); ++a) {
      auto* label = qobject_cast<QLabel*>(parts[a]);
      if (label != nullptr && label->wordWrap() && label->height() < label->heightForWidth(label->width()))
        return "cut: " + label->text();
      for (int b = 0; b < a; ++b)
        if (place(parts[a]).intersects(place(parts[b])))
          return parts[a]->objectName() + " lies over " + parts[b]->objectName();
    }
    return {};
  }
};

TEST_F(DesignPanelTest, ALawOfTheRubberIsChosenWithItsOwnConstants) {
  auto& law = find<QComboBox>("material.law");
  EXPECT_TRUE(find<QLineEdit>("material.c20_MPa").isHidden());
  law.setFocus();
  QTest::keyClick(&law, Qt::Key_Down);
  QTest::keyClick(&law, Qt::Key_Down);
  settle();
  const double mu = paperDesign().material.shearModulus_MPa();
  EXPECT_EQ(workbench.project().design.material.law, RubberLaw(Yeoh{mu / 2, 0, 0})) << "as stiff as before";
  EXPECT_TRUE(find<QLineEdit>("material.c01_MPa").isHidden());
  EXPECT_TRUE(find<QLineEdit>("material.c20_MPa").isVisible());
  EXPECT_EQ(workbench.history().undoText(), "rubber law Mooney-Rivlin -> Yeoh");
  type("material.c20_MPa", "0.05");
  EXPECT_EQ(workbench.project().design.material.law, RubberLaw(Yeoh{mu / 2, 0.05, 0}));
  type("material.c10_MPa", "0");
  EXPECT_TRUE(problemAt("material.c10_MPa").contains("above 0")) << problemAt("material.c10_MPa").toStdString();
  SensorDesign ogden = paperDesign();
  ogden.material.law = Ogden{{0.4, 0.02}, {2, 5}};
  workbench.edit("another design", [&] {
    Project next = workbench.project();
    next.design = ogden;
    return next;
  }());
  settle();
  EXPECT_EQ(law.currentText(), "Ogden");
  EXPECT_EQ(find<QLineEdit>("material.alpha").text(), "2, 5");
  type("material.alpha", "2, 6");
  EXPECT_EQ(workbench.project().design.material.law, RubberLaw(Ogden{{0.4, 0.02}, {2, 6}}));
  EXPECT_EQ(overlaps(), QString());
}

TEST_F(DesignPanelTest, AnErrorStandsUnderItsFieldAndCoversNoOther) {
  settle();
  ASSERT_EQ(overlaps(), QString());
  const int before = find<QLineEdit>("upper_layer.electrode_x_mm").mapTo(&window, QPoint()).y() -
                     find<QLineEdit>("upper_layer.row_wire_y_mm").mapTo(&window, QPoint()).y();
  type("upper_layer.row_wire_y_mm", "1.5, 4.5, ..., 28.4");
  EXPECT_TRUE(problemAt("upper_layer.row_wire_y_mm").contains("28.4"));
  EXPECT_EQ(overlaps(), QString());
  const int after = find<QLineEdit>("upper_layer.electrode_x_mm").mapTo(&window, QPoint()).y() -
                    find<QLineEdit>("upper_layer.row_wire_y_mm").mapTo(&window, QPoint()).y();
  EXPECT_GT(after, before) << "the sentence pushes the rest down";
  // Others of other lengths, in any order, with two at once.
  type("upper_layer.row_wire_y_mm", "1, x");
  EXPECT_EQ(overlaps(), QString());
  type("lower_layer.electrode_y_mm", "1, 2, ..., 2.5");
  EXPECT_EQ(overlaps(), QString());
  type("upper_layer.row_wire_y_mm", "1.5, 4.5, ..., 28.5");
  EXPECT_EQ(overlaps(), QString());
}

TEST_F(DesignPanelTest, AFieldThatIsNotAppliedSaysSoAtItself) {
  type("block_mm[0]", "4"); // good by itself, but then the electrodes lie outside
  EXPECT_EQ(workbench.project().design, paperDesign());
  EXPECT_TRUE(problemAt("block_mm[0]").contains("30 mm")) << problemAt("block_mm[0]").toStdString();
  EXPECT_TRUE(find<QLineEdit>("block_mm[0]").property("wrong").toBool());
  EXPECT_EQ(problemAt("block_mm[1]"), QString()) << "what stands there is in use";
  type("block_mm[0]", "40");
  EXPECT_EQ(workbench.project().design.block_mm.x(), 40);
  EXPECT_EQ(problemAt("block_mm[0]"), QString());
  EXPECT_FALSE(find<QLineEdit>("block_mm[0]").property("wrong").toBool());
}

TEST_F(DesignPanelTest, ScalesTheWiresWithTheBlockWhileItsSizeIsTypedAndUndoesItAtOnce) {
  find<QCheckBox>("scaleWires").click();
  type("block_mm[0]", "40"); // goes through "4": wires of that block would be far too narrow
  type("block_mm[1]", "45.5");
  type("block_mm[2]", "8");
  const SensorDesign& design = workbench.project().design;
  EXPECT_EQ(design.block_mm, Eigen::Vector3d(40, 45.5, 8));
  EXPECT_EQ(design, scaledTo(paperDesign(), {40, 45.5, 8})) << "not by what was typed on the way";
  EXPECT_NEAR(design.lower.wire_mm.back(), 29.5 * 40 / 30, 1e-8);
  EXPECT_EQ(find<QLineEdit>("lower_layer.column_wire_x_mm").text().count(','), 3) << "still evenly spaced";
  EXPECT_EQ(overlaps(), QString());
  while (workbench.history().canUndo()) workbench.history().undo();
  EXPECT_EQ(workbench.project().design, paperDesign());
}

TEST(WireScaling, GivesNoDigitsOfRounding) {
  const SensorDesign paper = paperDesign();
  for (const double x_mm : {22., 37.3, 31.}) {
    const SensorDesign scaled = scaledTo(paper, {x_mm, 22, 11});
    for (const ElectrodeLayer* layer : {&scaled.upper, &scaled.lower})
      for (const double place : layer->wire_mm) {
        const QString words = QString::number(place, 'g', QLocale::FloatingPointShortest);
        EXPECT_LE(words.size() - words.indexOf('.') - 1, 9) << words.toStdString();
      }
  }
}

TEST(WireScaling, KeepsEveryPlaceInItsShareOfTheBlock) {
  SensorDesign design = paperDesign();
  design.upper.wire_mm[3] += 0.1; // uneven
  const SensorDesign twice = scaledTo(design, 2 * design.block_mm);
  EXPECT_TRUE(check(twice).empty());
  EXPECT_TRUE(twice.upperElectrodes_mm().isApprox(2 * design.upperElectrodes_mm(), 1e-9));
  EXPECT_TRUE(twice.lowerElectrodes_mm().isApprox(2 * design.lowerElectrodes_mm(), 1e-9));
  EXPECT_EQ(scaledTo(design, design.block_mm), design);
}

} // namespace
} // namespace palp
