#include "app/gui/window/Application.h"

#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <cstdlib>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  // What a session of a desktop would have set.
  const QTemporaryDir runtime;
  setenv("QT_QPA_PLATFORM", "offscreen", 0);
  setenv("XDG_RUNTIME_DIR", runtime.path().toLocal8Bit().constData(), 0);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1); // pictures of the software renderer, which are the same everywhere
  palp::Application application(argc, argv);
  // The last catch keeps a window alive; in a test what it caught is a failure, unless the test waits for it.
  QObject::connect(&application, &palp::Application::faulted, [&application](const QString& what) {
    if (!application.property("faultExpected").toBool()) ADD_FAILURE() << "left a slot: " << what.toStdString();
  });
  // Settings of their own: a test neither reads nor changes the user's, nor those of a test that runs beside it.
  const QTemporaryDir settings;
  QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
  QApplication::setOrganizationName("palp-tests");
  QApplication::setApplicationName("palp-gui-tests");
  QStandardPaths::setTestModeEnabled(true);
  return RUN_ALL_TESTS();
}
