#include "app/gui/window/StatusLamps.h"

#include "app/gui/live/LiveBoards.h"
#include "app/gui/window/JobStrip.h"

#include <QStatusBar>
#include <QToolButton>

#include <algorithm>

namespace palp {

StatusLamps::StatusLamps(LiveBoards& live, QStatusBar* bar) : QObject(bar), live_(live), bar_(*bar) {
  connect(&live_, &LiveBoards::looked, this, &StatusLamps::displayBoards);
  connect(&live_, &LiveBoards::countChanged, this, &StatusLamps::displayBoards);
  report_ = new QToolButton;
  report_->setObjectName("reportLamp");
  report_->setAutoRaise(true);
  report_->setToolTip(tr("A report is running; a click opens the Reports scene"));
  report_->hide();
  connect(report_, &QToolButton::clicked, this, [this] { emit sceneRequested("reports"); });
  bar_.addPermanentWidget(report_);
}

void StatusLamps::showReport(const QString& words) {
  report_->setText(words);
  report_->setVisible(!words.isEmpty());
}

void StatusLamps::displayBoards() {
  const std::vector<LiveLampState> states = live_.lamps();
  while (boards_.size() < states.size()) {
    auto* lamp = new LiveLamp;
    connect(lamp, &QToolButton::clicked, this, [this] { emit sceneRequested("live"); });
    bar_.insertPermanentWidget(static_cast<int>(boards_.size()), lamp);
    boards_.push_back(lamp);
  }
  for (std::size_t k = 0; k < boards_.size(); ++k) boards_[k]->display(k < states.size() ? states[k] : LiveLampState{});
}

void StatusLamps::setJobs(const std::vector<SceneJob>& jobs) {
  std::erase_if(jobs_, [&](const Shown& shown) {
    if (std::any_of(jobs.begin(), jobs.end(), [&](const SceneJob& job) { return job.runner == shown.job.runner; }))
      return false;
    shown.strip->deleteLater();
    return true;
  });
  for (const SceneJob& job : jobs) {
    if (std::any_of(jobs_.begin(), jobs_.end(), [&](const Shown& shown) { return shown.job.runner == job.runner; }))
      continue;
    auto* strip = new JobStrip(*job.runner);
    connect(strip, &JobStrip::message, this, &StatusLamps::message);
    connect(strip, &JobStrip::sceneRequested, this, [this, scene = job.scene] { emit sceneRequested(scene); });
    bar_.addPermanentWidget(strip);
    jobs_.push_back({job, strip});
  }
}

bool StatusLamps::busy() const {
  return std::any_of(jobs_.begin(), jobs_.end(), [](const Shown& shown) { return shown.job.runner->running(); });
}

void StatusLamps::cancel(const QString& scene) {
  bool any = false;
  for (const Shown& shown : jobs_) {
    if (shown.job.scene != scene || !shown.job.runner->running()) continue;
    shown.job.runner->cancel();
    any = true;
  }
  if (!any) cancelAll();
}

void StatusLamps::cancelAll() {
  for (const Shown& shown : jobs_) shown.job.runner->cancel();
}

} // namespace palp
