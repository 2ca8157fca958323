#include "app/gui/design/ProgressWords.h"

#include "app/gui/jobs/JobRunner.h"

#include <QLabel>

namespace palp {

void sayProgress(JobRunner& runner, QLabel& label) {
  QObject::connect(&runner, &JobRunner::progressed, &label, [&label](double share, const QString& what) {
    label.setText(share < 0 ? QObject::tr("Computing: %1").arg(what)
                            : QObject::tr("Computing, %1 %: %2").arg(qRound(100 * share)).arg(what));
  });
}

} // namespace palp
