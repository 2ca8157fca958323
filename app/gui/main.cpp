#include "app/gui/document/Autosave.h"
#include "app/gui/document/Document.h"
#include "app/gui/document/Recovery.h"
#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/project/FileKind.h"
#include "app/gui/project/ProjectFile.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/window/Application.h"
#include "app/gui/window/Layout.h"
#include "app/gui/window/LogFile.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/MessageLog.h"
#include "app/gui/window/SceneCosts.h"
#include "app/gui/window/Snapshot.h"
#include "app/gui/window/Style.h"
#include "app/study/Version.h"
#include "model/base/Error.h"

#include <QCommandLineParser>
#include <QFileInfo>
#include <QScreen>
#include <QTimer>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <iostream>
#include <string_view>

namespace {

/// What the command line asks for.
struct Wish {
  QString scene, snapshot, theme, file;
  bool costs = false;
  palp::MeshOptions mesh;
};

/// Throws Error where a mesh cannot be meant.
palp::MeshOptions meshOf(const QString& size_mm, const QString& mapped) {
  palp::MeshOptions mesh;
  bool good = true;
  if (!size_mm.isEmpty()) mesh.meshSize_mm = size_mm.toDouble(&good);
  if (!good || (mesh.meshSize_mm && !(*mesh.meshSize_mm > 0 && std::isfinite(*mesh.meshSize_mm))))
    throw palp::Error("--mesh-size " + size_mm.toStdString() + ": expected a finite number above 0");
  if (mapped.isEmpty()) return mesh;
  const QStringList counts = mapped.split('x');
  std::array<int, 3> elements{};
  for (std::size_t k = 0; k < 3; ++k) elements[k] = counts.value(static_cast<int>(k)).toInt();
  if (counts.size() != 3 || *std::min_element(elements.begin(), elements.end()) < 1 || mesh.meshSize_mm)
    throw palp::Error("--mapped " + mapped.toStdString() +
                      ": expected three numbers of elements, such as 10x10x5, without --mesh-size");
  mesh.mapped = elements;
  return mesh;
}

Wish parse(const QApplication& application) {
  QCommandLineParser parser;
  parser.setApplicationDescription("Desktop workbench for three-axis tactile sensors of conductive rubber.\n"
                                   "Example: palp-studio --scene deformation --snapshot block.png sensor.json");
  parser.addHelpOption();
  const QCommandLineOption scene("scene", "Open this scene.", "NAME");
  const QCommandLineOption snapshot("snapshot", "Write a picture of the complete window and exit.", "FILE");
  const QCommandLineOption theme("theme", "Colours: light, dark or contrast.", "NAME");
  const QCommandLineOption costs(
      "costs", "Go through the scenes (or that of --scene), print the cost of each step as JSON and exit.");
  const QCommandLineOption size("mesh-size", "Size of the tetrahedra in the bulk [mm].", "MM");
  const QCommandLineOption mapped("mapped", "Mapped hexahedra.", "NxNxN");
  const QCommandLineOption version({"v", "version"}, "Version, commit and libraries.");
  parser.addOptions({version, scene, snapshot, theme, costs, size, mapped});
  parser.addPositionalArgument("design.json", "A design or project file.", "[design.json]");
  parser.process(application);
  if (parser.isSet(version)) {
    std::cout << palp::versionInWords() << std::endl;
    std::exit(0);
  }
  if (parser.positionalArguments().size() > 1)
    throw palp::Error("design.json: " + std::to_string(parser.positionalArguments().size()) +
                      " files given, expected one");
  return {parser.value(scene), parser.value(snapshot),
          parser.value(theme), parser.positionalArguments().value(0),
          parser.isSet(costs), meshOf(parser.value(size), parser.value(mapped))};
}

/// Other files of ours are opened by the window. What cannot be read counts, so that its reader reports why.
bool holdsAProject(const QString& file) {
  const QFileInfo info(file);
  if (!info.isFile() || !info.isReadable()) return true;
  const palp::FileKind kind = palp::fileKind(file);
  return kind == palp::FileKind::Project || kind == palp::FileKind::Design;
}

int run(palp::Application& application) {
  const Wish wish = parse(application);
  palp::Project project = palp::exampleProject();
  const bool unattended = wish.costs || !wish.snapshot.isEmpty();
  bool readable = !wish.file.isEmpty() && (unattended || holdsAProject(wish.file));
  try {
    if (readable && unattended) palp::requireKind(wish.file, palp::FileKind::Design);
    if (readable) project = palp::loadProject(wish.file.toStdString(), project);
  } catch (const palp::Error& error) {
    if (unattended) throw;
    std::cerr << "palp-studio: " << error.what() << std::endl;
    readable = false;
  }
  if (wish.mesh.meshSize_mm || wish.mesh.mapped) project.mesh = wish.mesh;
  palp::applyTheme(application, palp::Theme::Light); // before any widget: later ones take its font
  palp::Workbench workbench(project);
  palp::NetworkSession network;
  palp::LogFile log(unattended ? QString() : palp::LogFile::standardFolder());
  palp::MainWindow window(workbench, network);
  window.findChild<palp::MessageLog*>()->keepIn(log);
  if (!wish.theme.isEmpty()) window.setTheme(palp::kThemes.value(wish.theme.toStdString()));
  QObject::connect(&application, &palp::Application::faulted, &window, [&window, unattended](const QString& what) {
    if (unattended) std::_Exit(1); // nobody is there to read a box; standard error has the words
    palp::showFault(window, what);
  });
  window.showScene(QString::fromStdString(project.view.scene));
  if (!wish.scene.isEmpty() && !window.showScene(wish.scene))
    throw palp::Error("--scene " + wish.scene.toStdString() + ": expected " +
                      window.sceneNames().join(", ").toStdString());
  if (wish.costs) {
    palp::printSceneCosts(window, workbench, wish.scene);
    return 0;
  }
  if (!unattended) palp::fitToScreen(window, window.screen()->availableGeometry());
  window.show();
  log.takeQtMessages();
  log.add("palp-studio " + QString::fromStdString(palp::version()) + " started");
  QObject::connect(&application, &palp::Application::faulted, &log, &palp::LogFile::add);
  if (!wish.snapshot.isEmpty()) {
    palp::snapshotWhenComplete(window, workbench, wish.snapshot);
    return QApplication::exec();
  }
  if (readable) window.document().beganWith(wish.file);
  const QString root = palp::Autosave::standardRoot();
  palp::Autosave autosave(workbench, network, window, root);
  QObject::connect(&autosave, &palp::Autosave::failed, &window, &palp::MainWindow::showMessage);
  QTimer::singleShot(0, &window, [&window, &autosave, &wish, root, readable] {
    // Other files of Palp open where they belong; the window reports any other file and stays.
    if (!wish.file.isEmpty() && !readable) window.document().open(wish.file);
    palp::offerRecovery(window, autosave, root);
  });
  return QApplication::exec();
}

/// Without a display there are still pictures, costs and the help; false: a window was requested.
bool canStart(int argc, char** argv) {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"})
    if (std::getenv(name) != nullptr) return true;
  const bool unseen = std::any_of(argv, argv + argc, [](const std::string_view word) {
    return word.starts_with("--snapshot") || word == "--costs" || word == "--help" || word == "-h" ||
           word == "--version" || word == "-v";
  });
  if (unseen) setenv("QT_QPA_PLATFORM", "offscreen", 0);
  return unseen;
}

} // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN); // a file above the limit is refused with a message, as a full disk is
  if (!canStart(argc, argv)) {
    std::cerr << "palp-studio: no display (DISPLAY and WAYLAND_DISPLAY are not set); use --snapshot FILE to write a "
                 "picture without one\n";
    return 2;
  }
  palp::Application application(argc, argv);
  QApplication::setApplicationName("palp-studio");
  QApplication::setOrganizationName("palp");
  QApplication::setApplicationVersion(QString::fromStdString(palp::version()));
  try {
    return run(application);
  } catch (const std::exception& error) {
    std::cerr << "palp-studio: " << error.what() << "\n";
    return 2;
  }
}
