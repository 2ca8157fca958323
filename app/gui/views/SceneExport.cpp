#include "app/gui/views/SceneExport.h"

#include "app/gui/views/CsvExport.h"
#include "app/gui/views/DataTable.h"
#include "app/gui/views/PictureView.h"
#include "app/gui/views/VtkView.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/window/exports/ExportFiles.h"
#include "io/FilesTogether.h"
#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <QDir>
#include <QFileInfo>
#include <QMessageBox>
#include <QTimer>

#include <algorithm>
#include <memory>

namespace palp {

namespace {

constexpr QSize kLeast(600, 400);

/// Files of what it shows that are written already.
QStringList filesOf(const QWidget& scene) {
  const auto* page = dynamic_cast<const ExportFiles*>(&scene);
  return page == nullptr ? QStringList() : page->exportFiles();
}

/// Every view and table of the scene that shows something; those of other tabs too.
std::vector<QPointer<QWidget>> worthSaving(const QWidget& scene) {
  std::vector<QPointer<QWidget>> all;
  for (auto* view : scene.findChildren<PictureView*>())
    if (view->worthSaving() && !view->objectName().isEmpty()) all.emplace_back(view);
  for (auto* table : scene.findChildren<DataTable*>())
    if (table->rowCount() > 0) all.emplace_back(table);
  return all;
}

} // namespace

SceneExport::SceneExport(QObject* parent) : QObject(parent) {}

void SceneExport::ask(QWidget& scene) {
  if (running()) {
    emit done(tr("Charts and tables are still being written; export these afterwards."));
    return;
  }
  if (worthSaving(scene).empty() && filesOf(scene).isEmpty()) {
    emit done(tr("This scene shows no chart or table yet."));
    return;
  }
  const QString folder =
      askFileToSave(&scene, tr("Name of a new folder for all charts and tables"), scene.objectName() + "-charts", {});
  if (folder.isEmpty()) return;
  const QDir there(folder);
  if (there.exists() && !there.isEmpty())
    QMessageBox::warning(&scene, tr("Export all charts and tables"),
                         tr("%1 already contains files; enter the name of a new folder.").arg(folder));
  else if (!QDir().mkpath(folder))
    QMessageBox::warning(&scene, tr("Export all charts and tables"),
                         tr("%1: the folder cannot be created").arg(folder));
  else
    write(scene, folder);
}

void SceneExport::write(QWidget& scene, const QString& folder) {
  folder_ = folder;
  files_.clear();
  left_.clear();
  for (const QPointer<QWidget>& widget : worthSaving(scene)) left_.push_back({widget, {}});
  for (const QString& file : filesOf(scene)) {
    try {
      files_.push_back({QDir(folder).filePath(QFileInfo(file).fileName()), readFile(file.toStdString()), {}});
    } catch (const Error& error) { // deleted since it was shown
      emit done(QString::fromStdString(error.what()));
    }
  }
  QTimer::singleShot(0, this, &SceneExport::next);
}

/// One picture, then the window's own events again.
void SceneExport::next() {
  if (left_.empty()) return finish();
  const Piece piece = left_.back();
  left_.pop_back();
  QWidget* widget = piece.widget;
  const QDir folder(folder_);
  if (auto* table = qobject_cast<DataTable*>(widget))
    files_.push_back({folder.filePath(table->file()), (sourceOf(*table) + table->csv()).toStdString(), {}});
  auto* view = qobject_cast<PictureView*>(widget);
  if (view != nullptr && !piece.linesAs.isEmpty()) {
    files_.push_back({piece.linesAs, view->svg(), {}});
  } else if (view != nullptr) {
    const QString name = free(folder.filePath(view->fileName({})));
    const QString points = view->table();
    if (!points.isEmpty()) files_.push_back({name + ".csv", (sourceOf(*view) + points).toStdString(), {}});
    if (view->hasSvg()) left_.push_back({view, name + ".svg"});
    const QSize size = 2 * view->size().expandedTo(kLeast); // a tab that was never seen has no size yet
    files_.push_back({name + ".png", {}, view->picture(size.width(), size.height())});
    auto* drawn = qobject_cast<VtkView*>(view);
    if (drawn != nullptr && !drawn->isVisible()) drawn->giveBack(); // a context that nobody looks at
  }
  QTimer::singleShot(0, this, &SceneExport::next);
}

/// Views of several boards have the same names.
QString SceneExport::free(const QString& name) const {
  const auto taken = [this](const QString& path) {
    return std::any_of(files_.begin(), files_.end(), [&](const File& file) { return file.path == path + ".png"; });
  };
  QString path = name;
  for (int k = 2; taken(path); ++k) path = name + QString("-%1").arg(k);
  return path;
}

void SceneExport::finish() {
  const auto files = std::make_shared<std::vector<File>>(std::move(files_));
  files_.clear();
  writer_.start(
      tr("Writing charts and tables"),
      [this, files, folder = folder_](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        FilesTogether writing;
        for (std::size_t k = 0; k < files->size(); ++k) {
          throwIfStopped(stop);
          const File& file = (*files)[k];
          progress.set(static_cast<double>(k) / static_cast<double>(files->size()), file.path.toStdString());
          if (file.picture.empty())
            writing.add(file.path.toStdString(), file.content);
          else
            writing.add(file.path.toStdString(), [&](const auto& png) { writePng(file.picture, png); });
        }
        writing.commit();
        return
            [this, count = files->size(), folder] { emit done(tr("Wrote %1 files into %2.").arg(count).arg(folder)); };
      },
      JobRunner::Loss::Work);
}

} // namespace palp
