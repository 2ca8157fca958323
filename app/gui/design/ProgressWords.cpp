#include "app/gui/design/ProgressWords.h"

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/widgets/Markup.h"

#include <QLabel>

namespace palp {

void showProgress(JobRunner& runner, QLabel& label) {
  QObject::connect(&runner, &JobRunner::progressed, &label, [&label](double share, const QString& what) {
    const QString words = share < 0 ? QObject::tr("Computing: %1").arg(what)
                                    : QObject::tr("Computing, %1 %: %2").arg(qRound(100 * share)).arg(what);
    label.setText(label.textFormat() == Qt::RichText ? asWritten(words) : words);
  });
}

} // namespace palp
