#include "app/gui/MainWindow.h"
#include "app/gui/NetworkSession.h"
#include "app/gui/ProjectFile.h"
#include "app/gui/Snapshot.h"
#include "app/gui/Workbench.h"
#include "model/Error.h"

#include <QApplication>
#include <QCommandLineParser>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string_view>

namespace {

/// What the command line asks for.
struct Wish {
  QString scene, snapshot, theme, file;
};

Wish parse(const QApplication& application) {
  QCommandLineParser parser;
  parser.setApplicationDescription("Desktop workbench for three-axis tactile sensors of conductive rubber.\n"
                                   "Example: palp-studio --scene deformation --snapshot block.png sensor.json");
  parser.addHelpOption();
  parser.addVersionOption();
  const QCommandLineOption scene("scene", "Open on this scene.", "NAME");
  const QCommandLineOption snapshot("snapshot", "Write a picture of the window when it is complete, and end.", "FILE");
  const QCommandLineOption theme("theme", "light or dark.", "NAME");
  parser.addOptions({scene, snapshot, theme});
  parser.addPositionalArgument("design.json", "A design or project file.", "[design.json]");
  parser.process(application);
  if (parser.positionalArguments().size() > 1)
    throw palp::Error("design.json: " + std::to_string(parser.positionalArguments().size()) +
                      " files were given; allowed is one");
  return {parser.value(scene), parser.value(snapshot), parser.value(theme), parser.positionalArguments().value(0)};
}

int run(QApplication& application) {
  const Wish wish = parse(application);
  palp::Project project = palp::exampleProject();
  if (!wish.file.isEmpty()) project = palp::loadProject(wish.file.toStdString(), project);
  palp::Workbench workbench(project);
  palp::NetworkSession network;
  palp::MainWindow window(workbench, network);
  if (!wish.theme.isEmpty() && wish.theme != "light" && wish.theme != "dark")
    throw palp::Error("--theme " + wish.theme.toStdString() + ": allowed is light or dark");
  if (!wish.theme.isEmpty()) window.setTheme(wish.theme == "dark" ? palp::Theme::Dark : palp::Theme::Light);
  window.showScene(QString::fromStdString(project.view.scene));
  if (!wish.scene.isEmpty() && !window.showScene(wish.scene))
    throw palp::Error("--scene " + wish.scene.toStdString() + ": allowed is " +
                      window.sceneNames().join(", ").toStdString());
  window.show();
  if (!wish.snapshot.isEmpty()) palp::snapshotWhenComplete(window, workbench, network, wish.snapshot);
  return QApplication::exec();
}

/// A picture needs no display.
void goWithoutDisplay(int argc, char** argv) {
  const bool display = std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  const bool snapshot =
      std::any_of(argv, argv + argc, [](const char* word) { return std::string_view(word).starts_with("--snapshot"); });
  if (snapshot && !display) setenv("QT_QPA_PLATFORM", "offscreen", 0);
}

} // namespace

int main(int argc, char** argv) {
  goWithoutDisplay(argc, argv);
  QApplication application(argc, argv);
  QApplication::setApplicationName("palp-studio");
  QApplication::setOrganizationName("palp");
  QApplication::setApplicationVersion(PALP_VERSION);
  try {
    return run(application);
  } catch (const std::exception& error) {
    std::cerr << "palp-studio: " << error.what() << "\n";
    return 2;
  }
}
