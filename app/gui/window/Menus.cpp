#include "app/gui/window/Menus.h"

#include "app/gui/document/Document.h"
#include "app/gui/jobs/ExportJob.h"
#include "app/gui/project/ResultCsv.h"
#include "app/gui/project/Workbench.h"
#include "app/gui/touch/DeformationPage.h"
#include "app/gui/touch/FilmDialog.h"
#include "app/gui/views/PictureView.h"
#include "app/gui/views/SceneExport.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/Png.h"
#include "app/gui/window/MainWindow.h"
#include "app/gui/window/ViewActions.h"
#include "app/gui/window/exports/ExportSource.h"
#include "app/gui/window/help/HelpDialog.h"
#include "app/gui/window/history/UndoActions.h"
#include "app/scenes/CutTable.h"
#include "app/scenes/VtuFile.h"
#include "app/study/Resources.h"
#include "app/study/Version.h"
#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"
#include "solver/CalculixDeck.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QDir>
#include <QDockWidget>
#include <QMenuBar>
#include <QMessageBox>
#include <QObject>
#include <QRegularExpression>
#include <QUndoView>

#include <array>

namespace palp {

namespace {

struct Example {
  const char* file; ///< in resources/examples
  const char* title;
  const char* what;
};

constexpr std::array kExamples{
    Example{"paper.json", "The paper's sensor", "30 x 30 x 5 mm, one area pressed with 6 N"},
    Example{"better-layout.json", "A better layout",
            "The paper's block, its electrodes where the layout report puts them: one row-wire resolves 15 times more"},
    Example{"thick-soft-block.json", "A thick, soft block under a ball",
            "36 x 36 x 12 mm of soft rubber, the conduction field, read by virtual ground"},
};

/// Why the cut cannot be exported now, in a sentence; empty where it can.
QString cutProblem(Workbench& workbench, const DeformationPage& page) {
  if (workbench.touch().fields() == nullptr)
    return QObject::tr("There is no solution to export yet; wait until it is computed on the Deformation scene.");
  if (!page.blockOptions().cut)
    return QObject::tr("There is no cut: choose one across x, y or z in the panel of the Deformation scene.");
  if (page.blockOptions().lessReference && !page.shownLess())
    return QObject::tr("The difference from the reference design is not available yet; wait until it is computed.");
  return {};
}

/// The coloured field in the cut as it is shown, under lines with load, design and whether they still hold.
ExportJob::Making cutMaking(Workbench& workbench, const DeformationPage& page) {
  const TouchSession& touch = workbench.touch();
  return [shown = touch.touch(), fields = *touch.fields(), fraction = touch.loadFraction(), kept = page.shownLess(),
          options = page.blockOptions(), stale = touchStale(workbench)](const std::stop_token& stop) {
    DeformationState state;
    state.design = &shown.design();
    state.mesh = shown.mesh();
    state.fields = &fields;
    std::optional<LoadPathState> less;
    if (kept) state.kept = &less.emplace(kept->at(fraction)).fields;
    const ResultSource source{shown.design(), shown.load(), fraction, shown.meshOptions(), stale};
    return (sourceLines(source) + "# cut across " + "xyz"[options.cut->axis] + " at " +
            QString::number(options.cut->at_mm, 'g', 12) + " mm of the block as it is drawn, displacements times " +
            QString::number(
                options.deformationScale.value_or(automaticDeformationScale(shown.design(), fields.displacement_mm))) +
            "\n")
               .toStdString() +
           cutCsv(state, options, stop);
  };
}

} // namespace

Menus::Menus(MainWindow& window, Workbench& workbench, Document& document)
    : QObject(&window), window_(window), workbench_(workbench), document_(document) {
  buildFile();
  buildEdit();
  buildView();
  buildHelp();
}

QAction* Menus::add(QMenu& menu, const QString& text, const QString& tip, const QKeySequence& keys,
                    const std::function<void()>& act) {
  QAction* action = menu.addAction(text);
  action->setShortcut(keys);
  action->setStatusTip(tip);
  connect(action, &QAction::triggered, this, act);
  return action;
}

void Menus::buildFile() {
  QMenu& menu = *window_.menuBar()->addMenu(tr("&File"));
  add(menu, tr("&New (paper's sensor)"),
      tr("Starts a new project with the sensor of F. Wang et al., Sensors & Transducers 159 (11), 2013, and one "
         "example load"),
      QKeySequence::New, [this] { document_.startAnew(); });
  add(menu, tr("&Open..."), tr("Opens a design, project, samples, network, study or recording"), QKeySequence::Open,
      [this] { document_.open(); });
  add(menu, tr("&Import table..."), tr("Imports a table of measured data and opens its samples"), {},
      [this] { window_.chooseTables(); });
  recent_ = menu.addMenu(tr("Open &recent"));
  recent_->setObjectName("recent");
  connect(recent_, &QMenu::aboutToShow, this, &Menus::listRecent);
  listRecent();
  menu.addSeparator();
  add(menu, tr("&Save project"), tr("Saves the project"), QKeySequence::Save, [this] { document_.save(); });
  add(menu, tr("Save project &as..."), tr("Saves the project to another file"), QKeySequence("Ctrl+Shift+S"),
      [this] { document_.saveAs(); });
  add(menu, tr("Save &design..."), tr("Saves only the design, for the command line"), {}, [this] {
    exportTo(tr("Save design"), "sensor.json", tr("Designs (*.json)"),
             [this](const QString& file) { saveDesign(file.toStdString(), workbench_.project().design, true); });
  });
  menu.addSeparator();
  buildExport(menu);
  menu.addSeparator();
  add(menu, tr("&Quit"), tr("Ends the program"), QKeySequence("Ctrl+Q"), [this] { window_.close(); });
}

/// Of what is shown now; with the reference design where that is shown too.
ExportJob::Making Menus::vtuMaking() const {
  const TouchSession& touch = workbench_.touch();
  std::shared_ptr<const ReferencePath> kept;
  if (workbench_.project().view.lessReference) kept = workbench_.referencePath();
  return [shown = touch.touch(), fields = *touch.fields(), kept,
          fraction = touch.loadFraction()](const std::stop_token& stop) {
    std::vector<NodalArray> arrays = nodalArrays(fields);
    if (kept)
      for (NodalArray& array : nodalArrays(kept->at(fraction).fields)) {
        array.name = "kept_" + array.name;
        arrays.push_back(std::move(array));
      }
    return vtuText(*shown.mesh(), arrays, stop);
  };
}

/// Under the field they may not be there yet: the export computes them.
void Menus::exportResistances() {
  const TouchSession& session = workbench_.touch();
  if (session.electrodes() == nullptr) {
    window_.showMessage(tr("There are no displacements to export yet; wait until they are computed."));
    return;
  }
  const QString file = askFileToSave(&window_, tr("Export CSV"), "resistances.csv", tr("Tables (*.csv)"));
  if (file.isEmpty()) return;
  window_.exports().write(file, [touch = session.touch(), fraction = session.loadFraction(),
                                 known = workbench_.resistances(),
                                 stale = touchStale(workbench_)](const std::stop_token& stop) {
    const auto resistances = known ? known : fieldResistances(touch, fraction, stop);
    throwIfStopped(stop);
    return resistancesCsv({touch.design(), touch.load(), fraction, touch.meshOptions(), stale}, *resistances)
        .toStdString();
  });
}

void Menus::buildExport(QMenu& menu) {
  add(menu, tr("Export &VTU..."), tr("Exports mesh and fields as shown, for ParaView"), {}, [this] {
    if (workbench_.touch().fields() == nullptr) {
      window_.showMessage(
          tr("There is no solution to export yet; wait until it is computed on the Deformation scene."));
      return;
    }
    const QString file = askFileToSave(&window_, tr("Export VTU"), "deformed.vtu", tr("VTK files (*.vtu)"));
    if (!file.isEmpty()) window_.exports().write(file, vtuMaking());
  });
  add(menu, tr("Export &electrodes (CSV)..."),
      tr("Exports the displacements of the electrodes of both layers as shown, with load and design"), {}, [this] {
        const TouchSession& touch = workbench_.touch();
        if (touch.electrodes() == nullptr) {
          window_.showMessage(tr("There are no displacements to export yet; wait until they are computed."));
          return;
        }
        exportTo(tr("Export CSV"), "electrodes.csv", tr("Tables (*.csv)"), [this, &touch](const QString& name) {
          writeText(name, electrodesCsv({touch.touch().design(), touch.touch().load(), touch.loadFraction(),
                                         touch.touch().meshOptions(), touchStale(workbench_)},
                                        *touch.electrodes()));
        });
      });
  add(menu, tr("Export &resistances (CSV)..."),
      tr("Exports row-column resistances at rest and as shown, with load and design"), {},
      [this] { exportResistances(); });
  add(menu, tr("Export &field in the cut (CSV)..."),
      tr("Exports the values that colour the cut of the Deformation scene, with positions, displacements, load and "
         "design"),
      {}, [this] {
        if (const QString problem = cutProblem(workbench_, window_.deformation()); !problem.isEmpty()) {
          window_.showMessage(problem);
          return;
        }
        const QString file = askFileToSave(&window_, tr("Export CSV"), "cut.csv", tr("Tables (*.csv)"));
        if (!file.isEmpty()) window_.exports().write(file, cutMaking(workbench_, window_.deformation()));
      });
  add(menu, tr("Export Calculi&X deck..."),
      tr("Exports mesh, rubber and load as an input file for CalculiX or Abaqus, like palp mesh --format inp"), {},
      [this] {
        const Touch& touch = workbench_.touch().touch();
        if (touch.mesh() == nullptr) {
          window_.showMessage(tr("There is no mesh to export yet; wait until the Deformation scene has made it."));
          return;
        }
        const QString file =
            askFileToSave(&window_, tr("Export CalculiX deck"), "touch.inp", tr("Input decks (*.inp)"));
        if (file.isEmpty()) return;
        window_.exports().write(file, [touch](const std::stop_token& stop) {
          return calculixDeck(touch.design(), *touch.mesh(), touch.load(), stop);
        });
      });
  add(menu, tr("&Film of the load path..."),
      tr("Saves a film from rest to the full load with the present look of the block: an animated GIF or numbered "
         "pictures"),
      {}, [this] { makeFilm(); });
  add(menu, tr("Picture of the &view..."), tr("Saves the block, map or chart of the scene as PNG, without the panels"),
      QKeySequence("Ctrl+Shift+P"), [this] { saveView(); });
  add(menu, tr("Export all charts and &tables..."),
      tr("Saves every chart and table of this scene to a new folder: pictures, and their data as CSV"),
      QKeySequence("Ctrl+Shift+E"), [this] { window_.sceneExport().ask(window_.currentScene()); });
  add(menu, tr("&Picture of the window..."),
      tr("Saves the window as PNG; a right click on a view saves only that view"), QKeySequence("Ctrl+P"), [this] {
        exportTo(tr("Picture of the window"), "palp.png", tr("Pictures (*.png)"), [this](const QString& file) {
          writeFile(file.toStdString(), pngOf(windowPicture(window_)).toStdString(), true); // confirmed in the dialog
        });
      });
  add(menu, tr("Copy as co&mmand"), tr("Copies the palp commands that do what the scene shows to the clipboard"),
      QKeySequence("Ctrl+Shift+C"), [this] {
        const QString commands = window_.currentScene().commands(workbench_.project(), "sensor.json");
        if (commands.isEmpty()) {
          window_.showMessage(tr("This scene has no command."));
          return;
        }
        QApplication::clipboard()->setText(commands);
        const QStringList run = commands.split('\n').filter(QRegularExpression("^palp")); // less the remarks
        window_.showMessage(run.size() == 1 ? tr("Copied: %1   (sensor.json: File, Save design)").arg(run.value(0))
                                            : tr("Copied %1 commands, the first: %2   (sensor.json: File, Save design)")
                                                  .arg(run.size())
                                                  .arg(run.value(0)));
      });
}

void Menus::makeFilm() {
  const auto film = askForFilm(&window_, window_.filmedSize());
  if (!film) return;
  const QString path = film->gif ? askFileToSave(&window_, tr("Name of the film"), "film.gif", tr("Films (*.gif)"))
                                 : askFileToSave(&window_, tr("A new folder for the pictures"), "film", {});
  if (!path.isEmpty()) window_.animate(path, *film);
}

/// The largest view that is seen: the one that the scene is about.
void Menus::saveView() {
  PictureView* largest = nullptr;
  for (PictureView* view : window_.currentScene().findChildren<PictureView*>()) {
    if (!view->isVisible()) continue;
    const auto area = [](const QWidget& of) { return of.width() * of.height(); };
    if (largest == nullptr || area(*view) > area(*largest)) largest = view;
  }
  if (largest != nullptr)
    largest->savePicture();
  else
    window_.showMessage(tr("This scene shows no picture now."));
}

void Menus::buildEdit() {
  QMenu& menu = *window_.menuBar()->addMenu(tr("&Edit"));
  auto* undoing = new UndoActions(workbench_, this);
  menu.addActions({undoing->undo(), undoing->redo()});
  menu.addSeparator();
  add(menu, tr("&Compute again"), tr("Solves again after a cancellation"), QKeySequence("F5"), [this] {
    workbench_.touch().resume();
    workbench_.kept().resume();
    workbench_.field().retry();
    workbench_.referenceField().retry();
  });
  auto* dock = new QDockWidget(tr("History"), &window_);
  dock->setObjectName("history");
  auto* list = new QUndoView(&workbench_.history());
  list->setEmptyLabel(tr("Initial state"));
  list->setWordWrap(true);
  dock->setWidget(list);
  window_.addDockWidget(Qt::RightDockWidgetArea, dock);
  dock->hide();
  menu.addAction(dock->toggleViewAction());
}

void Menus::buildView() {
  QMenu& menu = *window_.menuBar()->addMenu(tr("&View"));
  int number = 1;
  for (const QString& name : window_.sceneNames()) {
    QString title = name;
    title[0] = title[0].toUpper();
    add(menu, title, tr("Shows the scene %1").arg(title), QKeySequence(QString("Ctrl+%1").arg(number++)),
        [this, name] { window_.showScene(name); });
  }
  menu.addSeparator();
  new ViewActions(window_, menu);
}

void Menus::buildHelp() {
  QMenu& menu = *window_.menuBar()->addMenu(tr("&Help"));
  add(menu, tr("&Help"), tr("Help on every scene, the mouse and the keys"), QKeySequence("F1"),
      [this] { showHelp(&window_, window_.currentScene().objectName()); });
  QMenu& examples = *menu.addMenu(tr("&Examples"));
  for (const Example& example : kExamples)
    add(examples, tr(example.title), tr(example.what), {}, [this, &example] {
      try {
        const std::string file = resource(std::string("examples/") + example.file).string();
        document_.openExample(QString::fromStdString(file), tr(example.title));
      } catch (const Error& missing) {
        QMessageBox::warning(&window_, tr("Examples"), QString::fromStdString(missing.what()));
      }
    });
  add(menu, tr("&About Palp"), tr("Version, paper and licence of this program"), {}, [this] {
    QMessageBox about(
        QMessageBox::NoIcon, tr("About Palp"),
        tr("<b>Palp %1</b><br>Follows a touch on a three-axis tactile sensor of conductive rubber from the block to "
           "the force.<br><br>The paper that it reproduces, and whose sensor it starts with: F. Wang et al., "
           "<i>Decoupling research of a three-dimensional force flexible tactile sensor based on radial basis function "
           "neural network</i>, Sensors &amp; Transducers 159 (11), 2013, 289-298.<br><br>A touch is a set of forces "
           "on areas and discs, or indenters with friction. Resistances follow from the paper's Eq. (1) or from the "
           "current in the rubber. A network decodes the force and, optionally, the position. Studies compare many "
           "designs. Hysteresis, creep and temperature of the rubber are not modelled: real sensors will do "
           "worse.<br><br>GNU Affero General Public License, version 3 or later.<br><br><small>%2</small>")
            .arg(QApplication::applicationVersion(),
                 QString::fromStdString(versionInWords()).toHtmlEscaped().replace('\n', "<br>")),
        QMessageBox::Ok, &window_);
    about.setTextFormat(Qt::RichText);
    about.setIconPixmap(window_.windowIcon().pixmap(64));
    about.exec();
  });
}

void Menus::listRecent() {
  recent_->clear();
  const QStringList files = Document::recent();
  for (const QString& file : files)
    add(*recent_, file, tr("Opens %1").arg(file), {}, [this, file] { document_.open(file); });
  if (files.isEmpty()) recent_->addAction(tr("No files opened or saved yet"))->setEnabled(false);
}

void Menus::exportTo(const QString& title, const QString& proposal, const QString& filter,
                     const std::function<void(const QString&)>& write) {
  const QString file = askFileToSave(&window_, title, proposal, filter);
  if (file.isEmpty()) return;
  try {
    write(file);
    window_.showMessage(tr("Wrote %1.").arg(file));
  } catch (const Error& error) {
    QMessageBox::warning(&window_, title, QString::fromStdString(error.what()));
  }
}

} // namespace palp
