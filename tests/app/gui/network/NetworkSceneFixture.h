#pragma once

#include "tests/app/gui/WindowFixture.h"

#include <QPushButton>
#include <QStatusBar>

namespace palp {

/// The Network scene with the load solved, and its two first buttons.
class NetworkScene : public WindowFixture {
protected:
  NetworkScene() {
    window.showScene("network");
    EXPECT_TRUE(solved());
  }
  void generate() {
    QTest::mouseClick(&find<QPushButton>("generate"), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.samples() != nullptr; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
  void trained() {
    QTest::mouseClick(&find<QPushButton>("train"), Qt::LeftButton);
    ASSERT_TRUE(QTest::qWaitFor([&] { return network.fit() != nullptr; }, kPatience_ms));
    ASSERT_TRUE(idle());
  }
};

} // namespace palp
