#include "app/gui/views/BlockView.h"
#include "app/gui/views/ChartView.h"
#include "app/gui/views/HeatmapView.h"
#include "tests/app/gui/WindowFixture.h"

#include <vtkCamera.h>

#include <QAbstractButton>
#include <QComboBox>
#include <QLabel>
#include <QTabWidget>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// What the mouse does with the views, by keys.
class Keyboard : public WindowFixture {
protected:
  BlockView& block() { return find<BlockView>("block"); }
  bool drawn() {
    const bool there = solved() && idle();
    settle();
    static_cast<void>(block().image());
    return there;
  }
  /// Focus, as Tab gives it.
  void focus(QWidget& widget) {
    window.activateWindow();
    widget.setFocus(Qt::TabFocusReason);
    ASSERT_TRUE(QTest::qWaitFor([&] { return widget.hasFocus(); }, kPatience_ms));
  }
  void press(QWidget& widget, Qt::Key key, Qt::KeyboardModifiers modifiers = {}, int times = 1) {
    for (int k = 0; k < times; ++k) QTest::keyClick(&widget, key, modifiers);
  }
  /// The cross goes to a place of the view, to a pixel.
  void cross(BlockView& view, const QPointF& to) {
    if (!view.cross()) press(view, Qt::Key_Right, Qt::ControlModifier);
    const auto way = [&] { return to - *view.cross(); };
    press(view, way().x() > 0 ? Qt::Key_Right : Qt::Key_Left, Qt::ControlModifier,
          static_cast<int>(std::abs(way().x()) / 10));
    press(view, way().y() > 0 ? Qt::Key_Down : Qt::Key_Up, Qt::ControlModifier,
          static_cast<int>(std::abs(way().y()) / 10));
    const auto fine = Qt::ControlModifier | Qt::ShiftModifier;
    press(view, way().x() > 0 ? Qt::Key_Right : Qt::Key_Left, fine, static_cast<int>(std::abs(way().x())));
    press(view, way().y() > 0 ? Qt::Key_Down : Qt::Key_Up, fine, static_cast<int>(std::abs(way().y())));
    EXPECT_LT(std::hypot(way().x(), way().y()), 2);
  }
  std::array<double, 3> focalPoint() {
    std::array<double, 3> point{};
    block().camera()->GetFocalPoint(point.data());
    return point;
  }
  double distance() { return block().camera()->GetDistance(); }
};

TEST_F(Keyboard, EveryViewOfASceneIsReachedByTabAndShowsItsFocus) {
  ASSERT_TRUE(drawn());
  QStringList reached;
  QWidget* at = &find<QWidget>("clickProbe");
  for (int k = 0; k < 200; ++k) {
    at = at->nextInFocusChain();
    if (at->isVisible() && (at->focusPolicy() & Qt::TabFocus) != 0) reached << at->objectName();
  }
  for (const char* view : {"block", "heatmap", "newton"}) EXPECT_TRUE(reached.contains(view)) << view;
  QWidget& view = block();
  const QImage before = view.grab().toImage();
  focus(block());
  const QImage after = view.grab().toImage();
  const QPoint edge(1, after.height() / 2);
  EXPECT_NE(before.pixelColor(edge), after.pixelColor(edge));
  EXPECT_EQ(after.pixelColor(edge), block().palette().color(QPalette::Highlight));
}

TEST_F(Keyboard, TurnsMovesAndZoomsTheBlock) {
  ASSERT_TRUE(drawn());
  focus(block());
  const auto eye = block().cameraPosition();
  const auto middle = focalPoint();
  const double away = distance();
  press(block(), Qt::Key_Left, {}, 3);
  EXPECT_NE(block().cameraPosition(), eye);
  EXPECT_NEAR(distance(), away, 1e-6 * away);
  EXPECT_EQ(focalPoint(), middle) << "turning moves nothing";
  const auto turned = block().cameraPosition();
  press(block(), Qt::Key_Right, {}, 3);
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(block().cameraPosition()[d], eye[d], 1e-6 * away);
  EXPECT_NE(block().cameraPosition(), turned);
  press(block(), Qt::Key_Up, Qt::ShiftModifier, 2);
  EXPECT_NE(focalPoint(), middle);
  press(block(), Qt::Key_Plus);
  EXPECT_LT(distance(), away);
  press(block(), Qt::Key_Minus);
  EXPECT_NEAR(distance(), away, 1e-6 * away);
  press(block(), Qt::Key_Home);
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(block().cameraPosition()[d], eye[d], 1e-6 * away);
}

TEST_F(Keyboard, ProbesAPointUnderTheCross) {
  ASSERT_TRUE(drawn());
  focus(block());
  EXPECT_FALSE(find<QLabel>("probe").text().contains("Point ("));
  cross(block(), block().placeOf({15, 15, 5}));
  press(block(), Qt::Key_Space);
  EXPECT_TRUE(find<QLabel>("probe").text().contains("Point (")) << find<QLabel>("probe").text().toStdString();
}

TEST_F(Keyboard, CarriesTheEndOfAnArrowAndUndoTakesItBack) {
  ASSERT_TRUE(drawn());
  focus(block());
  const Eigen::Vector3d before = workbench.project().load.areas[0].force_N;
  press(block(), Qt::Key_N); // to the arrow's end
  ASSERT_TRUE(block().cross().has_value());
  const QPointF off = *block().cross() - *block().gripOf(0);
  EXPECT_LT(std::hypot(off.x(), off.y()), 2);
  press(block(), Qt::Key_Space);
  press(block(), Qt::Key_Up, Qt::ControlModifier, 3);
  EXPECT_EQ(workbench.project().load.areas[0].force_N, before) << "held, not let go";
  press(block(), Qt::Key_Space);
  const Eigen::Vector3d after = workbench.project().load.areas[0].force_N;
  EXPECT_LT(after.z(), before.z() - 0.1) << "the arrow grew";
  workbench.history().undo();
  EXPECT_EQ(workbench.project().load.areas[0].force_N, before);
}

TEST_F(Keyboard, CarriesTheKnobOfACut) {
  find<QComboBox>("cut").setCurrentIndex(1); // across x
  ASSERT_TRUE(drawn());
  focus(block());
  const double before = workbench.project().view.cut->at_mm;
  for (int k = 0; k < 4 && (!block().cross() || (*block().cross() - *block().cutGrip()).manhattanLength() > 2); ++k)
    press(block(), Qt::Key_N);
  press(block(), Qt::Key_Space);
  press(block(), Qt::Key_Right, Qt::ControlModifier, 5);
  press(block(), Qt::Key_Space);
  EXPECT_GT(workbench.project().view.cut->at_mm, before + 0.5);
}

TEST_F(Keyboard, MakesADiscMovesAndSizesIt) {
  ASSERT_TRUE(drawn());
  find<QAbstractButton>("clickDisc").click();
  focus(block());
  cross(block(), block().placeOf({15, 15, 5}));
  press(block(), Qt::Key_Space);
  ASSERT_EQ(workbench.project().load.patches.size(), 1u);
  ASSERT_TRUE(drawn());
  const auto disc = [&] { return workbench.project().load.patches[0]; };
  const PatchLoad made = disc();
  EXPECT_NEAR(made.centre_mm.x(), 15, 1);
  const auto top = [](const Eigen::Vector2d& place) { return Eigen::Vector3d(place.x(), place.y(), 5); };
  cross(block(), block().placeOf(top(made.centre_mm)));
  press(block(), Qt::Key_Space);
  cross(block(), block().placeOf(top(made.centre_mm + Eigen::Vector2d(4, 0))));
  press(block(), Qt::Key_Space);
  EXPECT_NEAR(disc().centre_mm.x(), made.centre_mm.x() + 4, 0.5);
  EXPECT_EQ(disc().radius_mm, made.radius_mm);
  ASSERT_TRUE(drawn());
  cross(block(), block().placeOf(top(disc().centre_mm + Eigen::Vector2d(disc().radius_mm, 0))));
  press(block(), Qt::Key_Space);
  cross(block(), block().placeOf(top(disc().centre_mm + Eigen::Vector2d(disc().radius_mm + 2, 0))));
  press(block(), Qt::Key_Space);
  EXPECT_NEAR(disc().radius_mm, made.radius_mm + 2, 0.5);
  ASSERT_TRUE(drawn());
  cross(block(), block().placeOf(top(disc().centre_mm)));
  press(block(), Qt::Key_Space, Qt::ShiftModifier);
  EXPECT_TRUE(workbench.project().load.patches.empty()) << "Shift takes it away, as with the mouse";
}

TEST_F(Keyboard, ChoosesACellOfTheHeatmapAndReadsIt) {
  window.showScene("resistance");
  ASSERT_TRUE(solved());
  settle();
  auto& heatmap = find<HeatmapView>("resistanceHeatmap");
  focus(heatmap);
  const std::array<int, 2> from = workbench.project().view.cell;
  press(heatmap, Qt::Key_Down);
  press(heatmap, Qt::Key_Left, {}, 3);
  const QString place = QString("Row-wire %1, column-wire %2").arg(from[0] - 1).arg(from[1] - 3);
  EXPECT_TRUE(find<QLabel>("reading").text().startsWith(place)) << find<QLabel>("reading").text().toStdString();
  EXPECT_EQ(workbench.project().view.cell, from) << "reading chooses nothing";
  press(heatmap, Qt::Key_Space);
  EXPECT_EQ(workbench.project().view.cell, (std::array{from[0] - 1, from[1] - 3}));
  press(heatmap, Qt::Key_Left, {}, 100);
  press(heatmap, Qt::Key_Return);
  EXPECT_EQ(workbench.project().view.cell[1], 0) << "and no further";
}

TEST_F(Keyboard, GoesFromPointToPointOfAChart) {
  window.showScene("resistance");
  ASSERT_TRUE(solved());
  auto& chart = find<ChartView>("rowCurve");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !chart.chart().series.empty(); }, kPatience_ms));
  static_cast<void>(chart.image());
  focus(chart);
  EXPECT_TRUE(chart.reading().isEmpty());
  press(chart, Qt::Key_Right, Qt::ControlModifier, 3);
  const ChartSeries& curve = chart.chart().series[0];
  EXPECT_EQ(chart.reading(), QString("2, %1").arg(curve.y[2], 0, 'g', 5));
  press(chart, Qt::Key_Left, Qt::ControlModifier);
  EXPECT_TRUE(chart.reading().startsWith("1, "));
  const auto place = *chart.placeOf({0, 1});
  press(chart, Qt::Key_Plus);
  static_cast<void>(chart.image());
  const auto zoomed = chart.placeOf({0, 1});
  EXPECT_NE(zoomed, place) << "zoomed";
  // What it draws with goes, as another project or scene lets it: the next first drawing, in parts, keeps the axes.
  chart.giveBack();
  const int drawn = chart.renderCount();
  chart.invalidate();
  ASSERT_TRUE(QTest::qWaitFor([&] { return chart.renderCount() > drawn; }, kPatience_ms));
  EXPECT_EQ(chart.placeOf({0, 1}), zoomed);
  press(chart, Qt::Key_Home);
  static_cast<void>(chart.image());
  EXPECT_EQ(*chart.placeOf({0, 1}), place);
}

TEST_F(Keyboard, ThePointUnderTheMouseIsReadToo) {
  window.showScene("resistance");
  ASSERT_TRUE(solved());
  auto& chart = find<ChartView>("rowCurve");
  ASSERT_TRUE(QTest::qWaitFor([&] { return !chart.chart().series.empty(); }, kPatience_ms));
  static_cast<void>(chart.image());
  const QPoint place = chart.placeOf({0, 7})->toPoint();
  QMouseEvent move(QEvent::MouseMove, place, chart.mapToGlobal(place), Qt::NoButton, {}, {});
  QApplication::sendEvent(&chart, &move);
  EXPECT_TRUE(chart.reading().startsWith("7, ")) << chart.reading().toStdString();
}

TEST_F(Keyboard, LooksAtTheBlockOfTheResistanceSceneFromItsSides) {
  window.showScene("resistance");
  ASSERT_TRUE(solved());
  settle();
  auto& view = find<BlockView>("resistanceBlock");
  std::array<double, 3> along{};
  QTest::keyClick(&window, Qt::Key_Z);
  EXPECT_TRUE(QTest::qWaitFor(
      [&] {
        view.camera()->GetDirectionOfProjection(along.data());
        return along[2] < -1 + 1e-9;
      },
      kPatience_ms));
}

TEST_F(Keyboard, WordsOfHeatmapAndBlockGrowWithTheText) {
  ASSERT_TRUE(drawn());
  for (PictureView* view : std::initializer_list<PictureView*>{&block(), &find<HeatmapView>("heatmap")}) {
    const QImage before = view->image();
    QFont font = view->font();
    font.setPointSizeF(1.5 * font.pointSizeF());
    view->setFont(font);
    EXPECT_NE(view->image(), before) << view->objectName().toStdString();
    view->setFont({});
    EXPECT_EQ(view->image(), before) << view->objectName().toStdString();
  }
}

} // namespace
} // namespace palp
