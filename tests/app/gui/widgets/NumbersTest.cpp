#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/widgets/UnclearComma.h"
#include "io/StudyFile.h"
#include "model/TouchRange.h"
#include "model/base/NumberText.h"
#include "solver/CalculixDeck.h"
#include "solver/SensorMesh.h"
#include "tests/app/gui/WindowFixture.h"

#include <QClipboard>
#include <QFile>
#include <QLabel>
#include <QSpinBox>
#include <QStatusBar>
#include <QToolTip>

#include <clocale>
#include <langinfo.h>
#include <string_view>

namespace palp {
namespace {

// Part of these tests run a second time under a locale that writes commas: tests/app/gui/comma-locale.

/// The numbers' locale of the C library, as it was when this one goes.
class UsersNumbers {
public:
  UsersNumbers() { std::setlocale(LC_NUMERIC, ""); }
  ~UsersNumbers() { std::setlocale(LC_NUMERIC, "C"); }
  UsersNumbers(const UsersNumbers&) = delete;
  UsersNumbers& operator=(const UsersNumbers&) = delete;
  [[nodiscard]] static bool writeCommas() { return nl_langinfo(RADIXCHAR) == std::string_view(","); }
};

class Numbers : public WindowFixture {
protected:
  void type(QWidget& box, const QString& words, Qt::Key end = Qt::Key_Return) {
    box.setFocus();
    QMetaObject::invokeMethod(&box, "selectAll");
    QTest::keyClicks(&box, words);
    QTest::keyClick(&box, end);
  }
  QString said() { return window.statusBar()->currentMessage(); }
};

TEST(RatioBox, TakesTheNumberInItsUnitAndARatioWithAnExponent) {
  RatioBox box(1e6, "ppm");
  box.setDecimals(3);
  box.setRange(0, 1e6);
  for (const auto& [keys, ppm] : {std::pair{"1e-4", 100.0}, {"5E-6", 5.0}, {"7ppm", 7.0}, {"2e1 ppm", 20.0}}) {
    box.selectAll();
    QTest::keyClicks(&box, keys);
    QTest::keyClick(&box, Qt::Key_Return);
    EXPECT_DOUBLE_EQ(box.value(), ppm) << keys;
    EXPECT_EQ(box.text(), QString("%1 ppm").arg(ppm)) << keys;
  }
}

TEST(NumbersOfTheProcess, HaveADecimalPointWhateverTheUsersLocale) {
  EXPECT_STREQ(localeconv()->decimal_point, ".");
  EXPECT_EQ(QLocale().toString(1234567.5), "1.23457e+06");
  EXPECT_EQ(QLocale().toString(123456), "123456");
  QDoubleSpinBox ofQt;
  ofQt.setRange(0, 1e6);
  ofQt.setValue(1234.5);
  EXPECT_EQ(ofQt.text(), "1234.50");
}

TEST(NumbersOfTheProcess, AreCommasInTheLocaleThatTheSecondRunIsMadeFor) {
  const UsersNumbers users;
  if (!qEnvironmentVariable("LC_ALL").startsWith("de_DE")) GTEST_SKIP() << "not under tests/app/gui/comma-locale";
  EXPECT_TRUE(UsersNumbers::writeCommas());
}

// Where the C library itself writes commas, as it did in the window: no word of a file follows.
TEST(NumbersOfTheProcess, InFilesDoNotFollowTheCLibrary) {
  const SensorDesign design = paperDesign();
  LoadCase load;
  load.areas = {{0, {0.25, 0, -1.5}}};
  MeshOptions coarse;
  coarse.mapped = {3, 3, 2};
  const Mesh mesh = sensorMesh(design, coarse);
  const std::string deck = calculixDeck(design, mesh, load, {});
  const UsersNumbers users;
  EXPECT_EQ(calculixDeck(design, mesh, load, {}), deck);
  EXPECT_EQ(text(0.5), "0.5");
  EXPECT_EQ(withDigits(0.5, 3), "0.5");
  const StudyAxis axis = studyAxis("block_mm.2", "3.5..6.5 x 4");
  EXPECT_EQ(axis.from, 3.5);
  EXPECT_EQ(axis.to, 6.5);
  const auto indenter = indenterInWords("flat:3.5,0.25@3,3,27,27 press 1..5");
  ASSERT_TRUE(indenter);
  EXPECT_EQ(indenter->radius_mm, 3.5);
  EXPECT_EQ(indenter->rim_mm, 0.25);
}

TEST_F(Numbers, EveryBoxOfTheWindowIsOneThatDropsNoKey) {
  const auto boxes = window.findChildren<QAbstractSpinBox*>();
  EXPECT_GT(boxes.size(), 30);
  for (const QAbstractSpinBox* box : boxes)
    EXPECT_TRUE(dynamic_cast<const NumberBox*>(box) != nullptr || dynamic_cast<const WholeBox*>(box) != nullptr)
        << box->objectName().toStdString();
}

TEST_F(Numbers, ATypedCommaIsTheDecimalPoint) {
  window.showScene("deformation");
  auto& force = find<QDoubleSpinBox>("force_z");
  for (const char* words : {"-1,5", "-2.5", "-3,5"}) {
    type(force, words);
    EXPECT_EQ(force.value(), *typedNumber(words)) << words;
    EXPECT_EQ(workbench.project().load.areas[0].force_N.z(), *typedNumber(words)) << words;
    EXPECT_FALSE(force.text().contains(',')) << force.text().toStdString();
  }
}

TEST_F(Numbers, WhatABoxDoesNotTakeIsRefusedWithASentenceAndTheValueStays) {
  window.showScene("deformation");
  auto& force = find<QDoubleSpinBox>("force_z");
  type(force, "-1.5");
  for (const char* words : {"-1.234.5", "1.2.3", "abc", "-1e99", "-0.00001234", "1 000"}) {
    window.statusBar()->clearMessage();
    type(force, words);
    EXPECT_EQ(force.value(), -1.5) << words;
    EXPECT_EQ(workbench.project().load.areas[0].force_N.z(), -1.5) << words;
    EXPECT_TRUE(said().startsWith("Not applied: ") && said().contains(words)) << words << ": " << said().toStdString();
    EXPECT_TRUE(said().contains("-1.5")) << said().toStdString();
  }
  QApplication::clipboard()->setText("-1.234,5");
  force.setFocus();
  force.selectAll();
  QTest::keySequence(&force, QKeySequence::Paste);
  QTest::keyClick(&force, Qt::Key_Tab);
  EXPECT_EQ(force.value(), -1.5);
  EXPECT_TRUE(QTest::qWaitFor([] { return QToolTip::text().contains("-1.234,5"); }, kPatience_ms));
}

TEST_F(Numbers, AWholeNumberWithAFractionIsRefusedAndNotReadWithoutItsComma) {
  WholeBox box;
  box.setRange(0, 100000);
  box.setValue(7);
  box.show();
  for (const char* words : {"1,5", "1.5", "1,234", "-3", "1e3"}) {
    type(box, words);
    EXPECT_EQ(box.value(), 7) << words;
    EXPECT_EQ(box.text(), "7") << words;
  }
  type(box, "1234");
  EXPECT_EQ(box.value(), 1234);
}

TEST_F(Numbers, FieldsAndListsTakeACommaAsTheyDocumentIt) {
  EXPECT_EQ(typedNumber("1,5"), 1.5);
  EXPECT_EQ(typedNumber(" -1e-3 "), -1e-3);
  for (const char* none : {"1,234.5", "1.234,5", "1,2,3", "", "x", "nan", "inf", "1 000"})
    EXPECT_FALSE(typedNumber(none)) << none;
  window.showScene("design");
  auto& height = find<QLineEdit>("block_mm[2]");
  type(height, "4,5");
  settle();
  EXPECT_EQ(workbench.project().design.block_mm.z(), 4.5);
  auto& noise = find<QDoubleSpinBox>("resistanceNoise");
  for (const auto& [words, percent] :
       {std::pair{"0,02", 0.02}, std::pair{"1,5e-4", 0.015}, std::pair{"2,5e-2%", 0.025}}) {
    type(noise, words);
    EXPECT_NEAR(noise.value(), percent, 1e-12) << words;
  }
}

// "1,5" in a list was taken for 1 and 5.
TEST_F(Numbers, ADecimalCommaInAListIsRefusedAndSeparatesNothing) {
  for (const char* clear : {"", "1.5", "1, 5", "1.5,4.5", "0.5,5", "5,0.5", "1, 2,..., 9", "3..6 x 4", "1,"})
    EXPECT_EQ(unclearComma(clear), "") << clear;
  for (const char* unclear : {"1,5", "2, 1,5", "1,5 4.5", "3,5..6 x 2", "3..6,5 x 2", "1,4,7"})
    EXPECT_TRUE(unclearComma(unclear).contains(" is unclear: write ")) << unclear;
  EXPECT_EQ(unclearComma("3, 14,25"), "\"14,25\" is unclear: write 14.25 for one number, or \"14, 25\" for two");
  window.showScene("design");
  type(find<QLineEdit>("upper_layer.row_wire_y_mm"), "1,5, 4,5");
  EXPECT_TRUE(find<QLabel>("upper_layer.row_wire_y_mm problem").text().contains("write 1.5 for one"));
}

} // namespace
} // namespace palp
