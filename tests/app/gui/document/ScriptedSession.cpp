// A session that goes on until it is killed: forces are typed, samples made, networks trained, the project saved. Every
// force is printed before it is typed, so that who kills it knows what was done.
//   gui_session RECOVERY-FOLDER PROJECT-FILE
#include "app/gui/document/Autosave.h"
#include "app/gui/document/Document.h"
#include "app/gui/window/Application.h"
#include "tests/app/gui/WindowFixture.h"

#include <QDoubleSpinBox>
#include <QPushButton>

#include <iostream>

int main(int argc, char** argv) {
  palp::Application application(argc, argv);
  QApplication::setOrganizationName("palp-tests");
  QApplication::setApplicationName("palp-gui-session");
  const QStringList arguments = QApplication::arguments();
  palp::Workbench workbench(palp::quickProject());
  palp::NetworkSession network;
  palp::MainWindow window(workbench, network);
  palp::Autosave autosave(workbench, network, window, arguments.at(1));
  window.show();
  workbench.saved(arguments.at(2)); // so that no dialog asks for the name
  if (!window.document().save()) return 1;
  auto* force = window.findChild<QDoubleSpinBox*>("force_z");
  for (int step = 1;; ++step) {
    window.showScene("deformation");
    std::cout << step << std::endl;
    force->setFocus();
    force->selectAll();
    QTest::keyClicks(force, QString::number(-0.01 * (step % 900) - 0.01, 'f', 2));
    QTest::keyClick(force, Qt::Key_Return);
    QTest::qWait(100);
    if (step % 20 == 5) {
      window.showScene("network");
      window.findChild<QPushButton*>("generate")->click();
    }
    if (step % 20 == 12) window.findChild<QPushButton*>("train")->click();
    if (step % 20 == 0 && !window.document().save()) return 1;
  }
}
