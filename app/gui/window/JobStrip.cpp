#include "app/gui/window/JobStrip.h"

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/widgets/MakeWidgets.h"

#include <QHBoxLayout>
#include <QProgressBar>
#include <QPushButton>
#include <QToolButton>

#include <utility>

namespace palp {

namespace {

constexpr int kShownAfter_ms = 150;

} // namespace

JobStrip::JobStrip(JobRunner& runner, QWidget* parent) : QWidget(parent) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(4, 0, 4, 0);
  words_ = new QToolButton;
  words_->setObjectName("jobWords");
  words_->setAutoRaise(true);
  words_->setToolTip(tr("Shows the scene of this computation"));
  connect(words_, &QToolButton::clicked, this, &JobStrip::sceneRequested);
  bar_ = new QProgressBar;
  bar_->setFixedWidth(140);
  bar_->setMaximumHeight(14);
  bar_->setTextVisible(false);
  cancel_ = pushButton(tr("Cancel"), "cancel", tr("Cancels the computation; the last good result is kept (Esc)"));
  addTo(*row, {words_, bar_, cancel_});
  hide();
  wait_.setSingleShot(true);
  wait_.setInterval(kShownAfter_ms);
  connect(&wait_, &QTimer::timeout, this, &QWidget::show);
  connect(cancel_, &QPushButton::clicked, &runner, &JobRunner::cancel);
  connect(&runner, &JobRunner::started, this, [this, &runner](const QString& title) {
    words_->setText(title);
    bar_->setRange(0, 0);
    if (!isVisible() && !wait_.isActive()) wait_.start();
    const bool again = runner.orders() == JobRunner::Orders::Newest; // what failed before is tried again
    if (std::exchange(failed_, false) && again) emit message({});
  });
  connect(&runner, &JobRunner::progressed, this, [this](double share, const QString& what) {
    words_->setText(what);
    bar_->setRange(0, share < 0 ? 0 : 1000);
    if (share >= 0) bar_->setValue(static_cast<int>(1000 * share));
  });
  connect(&runner, &JobRunner::finished, this, [this, &runner](bool cancelled) {
    wait_.stop();
    hide();
    if (cancelled) emit message(tr("%1: cancelled; the last good result is kept.").arg(runner.title()));
  });
  connect(&runner, &JobRunner::dropped, this,
          [this](const QString& title) { emit message(tr("%1: cancelled; nothing was written.").arg(title)); });
  connect(&runner, &JobRunner::failed, this, [this](const QString& sentence) {
    failed_ = true;
    emit message(sentence);
  });
}

} // namespace palp
