#pragma once

#include "app/gui/live/LivePage.h"
#include "app/gui/live/LiveView.h"
#include "tests/app/gui/WindowFixture.h"

#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>

namespace palp {

/// No board on USB, whatever the machine has.
inline BoardAccess noBoards() {
  return {[] { return std::vector<HidBoard>{}; }, [](const std::string&) { return nullptr; }};
}

/// Agrees to whatever is asked while it lives.
class Agreeing {
public:
  Agreeing() {
    QObject::connect(&timer_, &QTimer::timeout, &timer_, [] {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
        QTest::mouseClick(box->button(QMessageBox::Yes), Qt::LeftButton);
    });
    timer_.start(20);
  }

private:
  QTimer timer_;
};

class Live : public testing::Test {
protected:
  explicit Live(BoardAccess access = noBoards()) : page(workbench, std::move(access)) {
    QObject::connect(&page, &LivePage::message, &page, [this](const QString& sentence) { said << sentence; });
    page.resize(1300, 800);
    page.show();
    EXPECT_TRUE(QTest::qWaitForWindowExposed(&page));
  }
  template <class Condition> static bool wait(const Condition& condition) {
    return QTest::qWaitFor(condition, kPatience_ms);
  }
  bool waitForFrames(std::uint64_t more = 5) {
    const std::uint64_t want = page.host().status().counts.frames + more;
    return wait([&] { return page.host().status().counts.frames >= want; });
  }
  bool waitForState(LiveState state) {
    return wait([&] { return page.host().status().state == state; });
  }
  bool waitForArrow() {
    return wait([&] { return !block().arrows().empty() && !block().stale(); });
  }
  template <class Widget> Widget& find(const char* name) {
    auto* widget = page.findChild<Widget*>(name);
    EXPECT_NE(widget, nullptr) << name;
    return *widget;
  }
  void click(const char* name) { QTest::mouseClick(&find<QPushButton>(name), Qt::LeftButton); }
  template <class Box> void type(const char* name, const QString& text) {
    auto& box = find<Box>(name);
    box.setFocus();
    box.selectAll();
    QTest::keyClicks(&box, text);
    QTest::keyClick(&box, Qt::Key_Return);
  }
  LiveView& block() { return find<LiveView>("liveBlock"); }
  QString banner() { return find<QLabel>("liveBanner").text(); }
  void use(const std::function<void(LiveSettings&)>& change) {
    Project next = workbench.project();
    change(next.live);
    workbench.edit("test", next);
  }

  Workbench workbench{exampleProject()};
  LivePage page;
  QStringList said;
};

} // namespace palp
