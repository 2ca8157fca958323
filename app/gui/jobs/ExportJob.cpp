#include "app/gui/jobs/ExportJob.h"

#include "io/AtomicFile.h"
#include "model/base/Cancelled.h"

namespace palp {

ExportJob::ExportJob(QObject* parent) : QObject(parent) {}

void ExportJob::write(const QString& file, Making make) {
  const QString title = tr("Writing %1").arg(file);
  runner_.start(
      title,
      [this, file, title, make = std::move(make)](const std::stop_token& stop,
                                                  JobProgress& progress) -> JobRunner::Taking {
        progress.set(-1, title.toStdString());
        const std::string content = make(stop);
        throwIfStopped(stop);
        writeFile(file.toStdString(), content, true); // confirmed in the dialog
        return [this, file] { emit done(tr("Wrote %1.").arg(file)); };
      },
      JobRunner::Loss::Work);
}

} // namespace palp
