#include "app/gui/window/Application.h"

#include "model/base/Error.h"
#include "tests/app/gui/WindowFixture.h"

#include <QFile>
#include <QLabel>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTimer>

#include <gtest/gtest.h>

namespace palp {
namespace {

/// A window on which faults are expected.
class LastCatch : public WindowFixture {
protected:
  LastCatch() {
    qApp->setProperty("faultExpected", true);
    QObject::connect(&application, &Application::faulted, &window,
                     [this](const QString& what) { showFault(window, what); });
  }
  ~LastCatch() override { qApp->setProperty("faultExpected", {}); }
  QMessageBox* box() { return window.findChild<QMessageBox*>("fault"); }

  Application& application = static_cast<Application&>(*qApp);
};

TEST_F(LastCatch, AnExceptionThatLeavesASlotIsSaidAndTheWindowGoesOn) {
  ASSERT_TRUE(solved());
  QPushButton button("fails", &window);
  QObject::connect(&button, &QPushButton::clicked, [] { throw Error("frames.csv: the file has gone"); });
  button.show();
  EXPECT_NO_THROW(QTest::mouseClick(&button, Qt::LeftButton));
  ASSERT_NE(box(), nullptr);
  EXPECT_TRUE(box()->isVisible());
  EXPECT_TRUE(box()->text().contains("frames.csv: the file has gone")) << box()->text().toStdString();
  box()->close();
  // The window still works: another force is solved.
  Project next = workbench.project();
  next.load.areas[0].force_N.z() = -2;
  workbench.edit("another force", next);
  EXPECT_TRUE(solved());
}

TEST(MessageBoxes, ShowNamesOfFilesAsTheyAreWritten) {
  QMessageBox box(QMessageBox::Warning, "Cannot open", "<a href=\"x\">march</a> & <b>april</b>.json: no valid JSON");
  box.setInformativeText("<i>as written</i>");
  box.show();
  for (const char* name : {"qt_msgbox_label", "qt_msgbox_informativelabel"})
    EXPECT_EQ(box.findChild<QLabel*>(name)->textFormat(), Qt::PlainText) << name;
  QMessageBox meant(QMessageBox::NoIcon, "About", "<b>Palp</b>");
  meant.setTextFormat(Qt::RichText);
  meant.show();
  EXPECT_EQ(meant.findChild<QLabel*>("qt_msgbox_label")->textFormat(), Qt::RichText);
}

TEST_F(LastCatch, AFaultThatComesAgainAndAgainOpensOneBox) {
  QSignalSpy faults(&application, &Application::faulted);
  QTimer timer;
  QObject::connect(&timer, &QTimer::timeout, [] { throw 7; }); // not even an exception of the library
  timer.start(1);
  ASSERT_TRUE(QTest::qWaitFor([&] { return faults.count() >= 5; }, kPatience_ms));
  timer.stop();
  EXPECT_EQ(window.findChildren<QMessageBox*>("fault").size(), 1);
}

TEST(Start, ABadFileIsSaidAndTheWindowOpensAllTheSame) {
  const QTemporaryDir home;
  QFile bad(home.filePath("bad.json"));
  ASSERT_TRUE(bad.open(QIODevice::WriteOnly));
  bad.write("{ \"palp_design\": ");
  bad.close();
  QProcess studio;
  QProcessEnvironment surroundings = QProcessEnvironment::systemEnvironment();
  for (const char* place : {"XDG_CONFIG_HOME", "XDG_DATA_HOME", "HOME"}) surroundings.insert(place, home.path());
  studio.setProcessEnvironment(surroundings);
  studio.start(QCoreApplication::applicationDirPath() + "/palp-studio", {bad.fileName()});
  QByteArray said;
  ASSERT_TRUE(QTest::qWaitFor(
      [&] {
        said += studio.readAllStandardError();
        return said.contains("bad.json") || studio.state() == QProcess::NotRunning;
      },
      kPatience_ms));
  EXPECT_TRUE(said.contains("bad.json")) << said.toStdString();
  EXPECT_FALSE(studio.waitForFinished(2000)) << "it ended instead of opening its window";
  studio.kill();
  studio.waitForFinished();
}

TEST(Start, AnotherFileOfPalpIsNoBrokenDesign) {
  const QTemporaryDir home;
  QFile samples(home.filePath("a.csv"));
  ASSERT_TRUE(samples.open(QIODevice::WriteOnly));
  samples.write("# palp_samples: 1\n");
  samples.close();
  QProcess studio;
  studio.start(QCoreApplication::applicationDirPath() + "/palp-studio",
               {"--snapshot", home.filePath("a.png"), samples.fileName()});
  ASSERT_TRUE(studio.waitForFinished(kPatience_ms));
  EXPECT_EQ(studio.exitCode(), 2);
  const QByteArray said = studio.readAllStandardError();
  EXPECT_TRUE(said.contains("a.csv: is samples, not a design")) << said.toStdString();
}

} // namespace
} // namespace palp
