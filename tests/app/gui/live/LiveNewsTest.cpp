// What happens to a board is said where one looks, and stands in the log of messages.

#include "app/gui/live/LiveNews.h"
#include "app/gui/views/StripChart.h"
#include "app/gui/widgets/EscapeKey.h"
#include "tests/app/gui/live/LiveOperatorFixture.h"

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QSpinBox>

namespace palp {
namespace {

class LiveNewsOfABoard : public LiveOperator {
protected:
  bool hears(const QString& part) {
    return wait([&] { return !said.filter(part).isEmpty(); });
  }
  void leaveAlone() {
    find<QCheckBox>("touchHeld").click();
    type<QDoubleSpinBox>("touch_Fz", "0");
  }
};

TEST_F(LiveNewsOfABoard, ABoardThatGoesAndAWireThatBreaksAreLoggedOnceEach) {
  ASSERT_TRUE(waitForFrames());
  EXPECT_TRUE(said.isEmpty()) << "what was so from the beginning is no news: " << said.join('|').toStdString();
  click("plug");
  ASSERT_TRUE(hears("Board unplugged"));
  click("plug");
  ASSERT_TRUE(hears("Board is back: simulated board"));
  type<QSpinBox>("openRow", "3");
  ASSERT_TRUE(hears("Broken: row-wire 3: open"));
  type<QSpinBox>("openRow", "-1");
  ASSERT_TRUE(hears("Repaired: row-wire 3: open"));
  ASSERT_TRUE(waitForFrames(20));
  for (const char* part : {"Board unplugged", "Board is back", "Broken: ", "Repaired: "})
    EXPECT_EQ(said.filter(part).size(), 1) << part;
}

TEST_F(LiveNewsOfABoard, ADriftIsSaidOnceAndNoTareCallsItOver) {
  ASSERT_TRUE(waitForFrames());
  leaveAlone();
  type<QDoubleSpinBox>("warming", "20");
  ASSERT_TRUE(hears("The sensor drifts"));
  click("tare");
  ASSERT_TRUE(hears("Tared (mean of "));
  ASSERT_TRUE(wait([&] { return said.filter("The sensor drifts").size() == 2; })) << "it goes on after the tare";
  ASSERT_TRUE(waitForFrames(100));
  EXPECT_EQ(said.filter("The sensor drifts").size(), 2) << said.join('|').toStdString();
  EXPECT_EQ(said.filter("Tared (mean of ").size(), 1);
}

TEST_F(LiveNewsOfABoard, AnotherNetworkIsLogged) {
  ASSERT_TRUE(waitForFrames());
  ASSERT_TRUE(wait([&] { return page.host().network().decoder().has_value(); }));
  ASSERT_TRUE(said.filter("Network in use:").isEmpty());
  page.host().network().refine(*page.host().network().decoder(), "another one");
  EXPECT_TRUE(hears("Network in use: another one."));
}

TEST_F(LiveNewsOfABoard, ADriftIsSaidInTheBannerWithAWayOutAndATareIsLogged) {
  ASSERT_TRUE(waitForFrames());
  leaveAlone();
  EXPECT_TRUE(find<QPushButton>("tareDue").isHidden());
  type<QDoubleSpinBox>("warming", "20");
  ASSERT_TRUE(wait([&] { return banner().contains("The sensor drifts"); })) << banner().toStdString();
  EXPECT_TRUE(find<QPushButton>("tareDue").isVisible());
  EXPECT_TRUE(wait([&] { return banner().contains("Wait until the drift is below"); })) << banner().toStdString();
  EXPECT_TRUE(hears("The sensor drifts"));
  EXPECT_TRUE(wait([&] { return find<QPushButton>("tare").toolTip() == driftWords(page.host().status()); }))
      << "the button says why";
  type<QDoubleSpinBox>("warming", "0");
  click("tareDue");
  ASSERT_TRUE(hears("Tared (mean of "));
  EXPECT_TRUE(wait([&] { return find<QPushButton>("tareDue").isHidden(); }));
  click("clearTare");
  EXPECT_TRUE(hears("Tare cleared"));
}

TEST_F(LiveNewsOfABoard, ForcesThatAreDoubtedAreGrey) {
  ASSERT_TRUE(waitForArrow());
  type<QDoubleSpinBox>("warming", "100");
  ASSERT_TRUE(wait([&] { return find<QLabel>("liveTrust").text() == "implausible"; }));
  EXPECT_TRUE(wait([&] { return block().stale(); }));
}

TEST_F(LiveNewsOfABoard, ABoardGoesOnWarmingWhileNobodyLooks) {
  ASSERT_TRUE(waitForFrames());
  type<QDoubleSpinBox>("warming", "100");
  const auto degrees = [&] { return page.host().status().temperature_degC.value_or(0); };
  ASSERT_TRUE(wait([&] { return degrees() > 24; }));
  const double before_degC = degrees();
  const auto connections = page.host().status().connections;
  click("plug");
  ASSERT_TRUE(waitForState(LiveState::Searching));
  click("plug");
  ASSERT_TRUE(wait([&] { return page.host().status().connections > connections && waitForFrames(); }));
  EXPECT_GE(degrees(), before_degC) << "it was cold again";
  EXPECT_LT(degrees(), before_degC + 10);
}

TEST_F(LiveNewsOfABoard, EscapeLetsHeldCurvesRunThoughItStopsWorkElsewhere) {
  ASSERT_TRUE(waitForFrames());
  EscapeKey escape(&page); // as the window has it
  int stopped = 0;
  QObject::connect(&escape, &EscapeKey::pressed, &page, [&stopped] { ++stopped; });
  auto& chart = find<StripChart>("forceCurves");
  chart.setFocus();
  QTest::keyClick(&chart, Qt::Key_Plus);
  ASSERT_TRUE(chart.held());
  QTest::keyClick(&chart, Qt::Key_Escape);
  EXPECT_FALSE(chart.held());
  EXPECT_EQ(stopped, 0);
  QTest::keyClick(&chart, Qt::Key_Escape);
  EXPECT_EQ(stopped, 1);
}

TEST(LiveNews, ADriftThatGoesOnSaysWhatToWaitFor) {
  LiveStatus status;
  EXPECT_EQ(driftWords(status), "");
  status.tareSuggested = true;
  status.driftForce_N = 0.2;
  EXPECT_TRUE(driftWords(status).contains("rest reads as 0.2 N. Leave it unloaded"));
  status.driftRate_N_min = 0.05;
  EXPECT_TRUE(driftWords(status).contains("Unload the sensor and tare"));
  status.driftsOn = true;
  status.driftRate_N_min = 1.5;
  status.steadyRate_N_min = 0.12;
  EXPECT_TRUE(driftWords(status).contains("still drifting at 1.5 N/min. Wait until the drift is below 0.12 N/min"))
      << driftWords(status).toStdString();
}

} // namespace
} // namespace palp
