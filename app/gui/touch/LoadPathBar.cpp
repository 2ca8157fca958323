#include "app/gui/touch/LoadPathBar.h"

#include "app/gui/jobs/TouchSession.h"
#include "app/gui/widgets/MakeWidgets.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QSignalBlocker>
#include <QSlider>
#include <QToolButton>

#include <algorithm>

namespace palp {

namespace {

constexpr int kStep_ms = 66; // 15 pictures a second
constexpr int kStep_percent = 3;
constexpr int kMostPictures = 90; // of a path: 6 s

} // namespace

LoadPathBar::LoadPathBar(TouchSession& session, QWidget* parent) : QWidget(parent), session_(session) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  play_ = new QToolButton;
  play_->setObjectName("playPath");
  play_->setText(tr("Play"));
  play_->setCheckable(true);
  play_->setShortcut(Qt::CTRL | Qt::Key_Space);
  play_->setToolTip(
      tr("Plays the load from rest to its full size (Ctrl+Space); File, Film of the load path saves it as a film"));
  loop_ = checkBox(tr("Loop"), "loopPath", tr("Restarts the playback at rest when it ends"));
  words_ = new QLabel;
  words_->setObjectName("pathWords");
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setObjectName("increments");
  slider_->setAccessibleName(tr("Share of the load"));
  slider_->setPageStep(10);
  for (QWidget* part : {static_cast<QWidget*>(play_), static_cast<QWidget*>(loop_), static_cast<QWidget*>(words_)})
    row->addWidget(part);
  row->addWidget(slider_, 1);
  timer_.setInterval(kStep_ms);
  connect(&timer_, &QTimer::timeout, this, &LoadPathBar::step);
  connect(play_, &QToolButton::toggled, this, &LoadPathBar::play);
  connect(slider_, &QSlider::valueChanged, this, &LoadPathBar::showPlace);
}

void LoadPathBar::display() {
  const QSignalBlocker quiet(slider_);
  const int last = session_.lastPlace();
  slider_->setRange(0, last);
  slider_->setEnabled(last > 0);
  play_->setEnabled(last > 0);
  slider_->setValue(std::max(session_.place(), 0));
  const int shown = std::max(session_.place(), 0);
  words_->setText(shown > 100 ? loadPlaceWords(0.01 * shown) : tr("%1 % of the load").arg(shown, 3));
  QStringList computed;
  if (const Solution* solution = session_.touch().solution())
    for (const LoadIncrement& state : solution->increments)
      computed << QString::number(100 * state.loadFraction, 'g', 3);
  slider_->setToolTip(tr("Load from rest to the full load%1. Equilibria are computed at %2 %; between them the "
                         "displacements are interpolated linearly.")
                          .arg(last > 100 ? tr(", followed by 100 positions for each step of the path") : QString(),
                               computed.join(", ")));
}

void LoadPathBar::hideEvent(QHideEvent* event) {
  QWidget::hideEvent(event);
  play_->setChecked(false);
}

void LoadPathBar::play(bool on) {
  if (!on) {
    timer_.stop();
    return;
  }
  if (session_.place() >= session_.lastPlace()) session_.showPlace(0);
  timer_.start();
}

void LoadPathBar::step() {
  if (session_.lastPlace() < 1) { // another load is being solved
    play_->setChecked(false);
    return;
  }
  if (session_.scrubbingTo() != session_.place()) return; // its fields are on their way
  const int place = session_.place(), last = session_.lastPlace();
  if (place < last) {
    session_.showPlace(std::min(place + std::max(kStep_percent, last / kMostPictures), last));
    return;
  }
  if (loop_->isChecked())
    session_.showPlace(0);
  else
    play_->setChecked(false);
}

void LoadPathBar::showPlace(int percent) {
  session_.showPlace(percent);
  if (session_.scrubbingTo() == percent) return;
  const QSignalBlocker quiet(slider_); // a solve runs: its result comes first
  slider_->setValue(std::max(session_.place(), 0));
}

} // namespace palp
