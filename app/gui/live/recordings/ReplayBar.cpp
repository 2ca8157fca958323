#include "app/gui/live/recordings/ReplayBar.h"

#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QStyle>
#include <QVBoxLayout>

#include <utility>

namespace palp {

namespace {

constexpr int kSteps = 10000; // of the slider
constexpr double kMostSpeed = 1000;
constexpr int kMarkWidth_px = 2;
constexpr int kMarkShare = 3; // of the time line's height, that a mark takes

/// A click goes to its time; it shows the recording's marks.
class TimeLine : public QSlider {
public:
  TimeLine() : QSlider(Qt::Horizontal) {}

  /// At these shares of its length.
  void setMarks(std::vector<double> shares) {
    marks_ = std::move(shares);
    update();
  }

protected:
  void paintEvent(QPaintEvent* event) override {
    QSlider::paintEvent(event);
    QPainter painter(this);
    painter.setPen(QPen(palette().color(QPalette::Text), kMarkWidth_px));
    for (const double share : marks_) {
      const int x = QStyle::sliderPositionFromValue(0, kSteps, qRound(kSteps * share), width());
      painter.drawLine(x, 0, x, height() / kMarkShare);
    }
  }
  void mousePressEvent(QMouseEvent* event) override {
    if (event->button() == Qt::LeftButton)
      setValue(QStyle::sliderValueFromPosition(minimum(), maximum(), qRound(event->position().x()), width()));
    QSlider::mousePressEvent(event);
  }

private:
  std::vector<double> marks_;
};

QDoubleSpinBox* timeBox(const QString& name, const QString& tip) {
  auto* box = numberBox(name, {.high = 0, .unit = QObject::tr(" s"), .whileTyping = true}, tip);
  return box;
}

} // namespace

ReplayBar::ReplayBar(LiveHost& host, QWidget* parent) : QWidget(parent), host_(host) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(2);
  buildTimeLine();
  buildLoop();
  auto* board = pushButton(tr("Back to the board"), "backToBoard",
                           tr("Ends the replay and returns to the first board, or to the simulated board"));
  auto* upper = new QHBoxLayout;
  for (QPushButton* button : {pause_, back_, step_}) upper->addWidget(button);
  addTo(*upper, {{line_, 1}, place_, length_});
  auto* lower = inRow({new QLabel(tr("Speed")), speed_, loop_, from_, new QLabel(tr("To")), to_, {marks_, 1}, board});
  column->addLayout(upper);
  column->addLayout(lower);
  connect(board, &QPushButton::clicked, this, &ReplayBar::boardRequested);
  hide();
}

void ReplayBar::buildTimeLine() {
  pause_ = pushButton(tr("Pause"), "replayPause",
                      tr("Pauses the recording or continues it; restarts it at its end (Space)"));
  step_ = pushButton(tr("Next frame"), "replayStep", tr("Steps forward by one frame and pauses (Period)"));
  back_ = pushButton(tr("Frame back"), "replayBack", tr("Steps back by one frame and pauses (Comma)"));
  line_ = new TimeLine;
  line_->setObjectName("replayLine");
  line_->setAccessibleName(tr("Position in the recording"));
  line_->setRange(0, kSteps);
  line_->setPageStep(kSteps / 20);
  line_->setSingleStep(kSteps / 200);
  line_->setToolTip(tr("Position in the recording: click or drag to go there"));
  place_ = timeBox("replayPlace", tr("Position in the recording [s]: enter a time to go there"));
  place_->setKeyboardTracking(false);
  length_ = new QLabel;
  length_->setObjectName("replayLength");
  connect(place_, &QDoubleSpinBox::valueChanged, this, [this](double to_s) {
    sought_ = true;
    goTo(to_s);
  });
  connect(place_->findChild<QLineEdit*>(), &QLineEdit::returnPressed, this, [this] {
    if (!std::exchange(sought_, false)) goTo(place_->value()); // the number is unchanged
    line_->setFocus();                                         // the box follows the recording again
  });
  connect(back_, &QPushButton::clicked, this, [this] { host_.step(-1); });
  connect(pause_, &QPushButton::clicked, this, [this] {
    if (host_.status().state == LiveState::Ended) return host_.seek(0);
    host_.setPaused(!host_.paused());
  });
  connect(step_, &QPushButton::clicked, this, [this] { host_.step(1); });
  connect(line_, &QSlider::valueChanged, this, [this](int value) {
    if (host_.replay() != nullptr) goTo(host_.replay()->length_s * value / kSteps);
  });
}

void ReplayBar::buildLoop() {
  speed_ = choiceBox("replaySpeed", {"0.1", "0.5", "1", "2", "10", "0"},
                     tr("Replay speed relative to the recording; 0 is as fast as the file can be read"));
  speed_->setEditable(true);
  speed_->setInsertPolicy(QComboBox::NoInsert);
  loop_ = checkBox(tr("Loop from"), "replayLoop", tr("Plays between these two times repeatedly"));
  marks_ = choiceBox("replayMarks", {}, tr("Event marks of the recording: select one to go there"));
  marks_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  connect(marks_, &QComboBox::activated, this, [this](int) {
    if (marks_->currentData().isValid()) goTo(marks_->currentData().toDouble());
  });
  from_ = timeBox("loopFrom", tr("Start of the loop [s]"));
  to_ = timeBox("loopTo", tr("End of the loop [s]"));
  connect(speed_, &QComboBox::currentTextChanged, this, [this](const QString& text) {
    const auto value = typedNumber(text);
    if (value && *value >= 0 && *value <= kMostSpeed) emit speedRequested(*value);
  });
  connect(speed_->lineEdit(), &QLineEdit::editingFinished, this, [this] {
    const auto value = typedNumber(speed_->currentText());
    if (value && *value >= 0 && *value <= kMostSpeed) return;
    showNotApplied(*speed_,
                   tr("Not applied: \"%1\" is not a number from 0 to %2").arg(speed_->currentText()).arg(kMostSpeed));
    showSpeed();
  });
  connect(loop_, &QCheckBox::toggled, this, &ReplayBar::loop);
  connect(from_, &QDoubleSpinBox::valueChanged, this, &ReplayBar::loop);
  connect(to_, &QDoubleSpinBox::valueChanged, this, &ReplayBar::loop);
}

void ReplayBar::loop() {
  ReplayControl* replay = host_.replay();
  if (replay == nullptr) return;
  replay->loopFrom_s = from_->value();
  replay->loopTo_s = to_->value();
  const bool wasOff = !replay->loop.exchange(loop_->isChecked());
  if (wasOff && loop_->isChecked() && host_.status().state == LiveState::Ended) host_.seek(from_->value());
}

void ReplayBar::goTo(double to_s) {
  if (loop_->isChecked() && (to_s < from_->value() || to_s > to_->value())) {
    loop_->setChecked(false);
    emit message(tr("The loop is off: %1 s is outside of it.").arg(to_s, 0, 'f', 2));
  }
  if (host_.status().state == LiveState::Ended) host_.setPaused(true); // it pauses there, instead of ending again
  host_.seek(to_s);
}

void ReplayBar::listMarks() {
  marks_->clear();
  const std::vector<ReplayMark> marks = host_.replay()->marks();
  marks_->addItem(marks.empty() ? tr("No marks") : tr("Go to a mark..."));
  for (const ReplayMark& mark : marks)
    marks_->addItem(tr("%1 s: %2").arg(mark.at_s, 0, 'f', 2).arg(QString::fromStdString(mark.text)), mark.at_s);
  marks_->setEnabled(!marks.empty());
  listedMarks_ = marks.size();
  std::vector<double> shares;
  for (const ReplayMark& mark : marks) shares.push_back(length_s_ > 0 ? mark.at_s / length_s_ : 0);
  static_cast<TimeLine*>(line_)->setMarks(std::move(shares));
}

void ReplayBar::display(const LiveSettings& settings) {
  speedInUse_ = settings.replaySpeed;
  showSpeed();
}

void ReplayBar::showSpeed() {
  const QSignalBlocker quiet(speed_);
  if (typedNumber(speed_->currentText()) != speedInUse_) speed_->setEditText(QString::number(speedInUse_, 'g', 6));
}

void ReplayBar::displayState() {
  const ReplayControl* replay = host_.replay();
  setVisible(replay != nullptr);
  if (replay == nullptr) return;
  const bool ended = host_.status().state == LiveState::Ended;
  const double length_s = replay->length_s;
  if (length_s != length_s_) { // another recording
    length_s_ = length_s;
    const QSignalBlocker quietFrom(from_), quietTo(to_), quietLoop(loop_);
    from_->setRange(0, length_s);
    to_->setRange(0, length_s);
    from_->setValue(0);
    to_->setValue(length_s);
    loop_->setChecked(false);
    const QSignalBlocker quietPlace(place_);
    place_->setRange(0, length_s);
    length_->setText(tr("of %1 s").arg(length_s, 0, 'f', 2));
    listMarks();
  } else if (replay->marks().size() != listedMarks_) { // a long recording is still read
    listMarks();
  }
  pause_->setText(ended ? tr("Play again") : host_.paused() ? tr("Continue") : tr("Pause"));
  step_->setEnabled(!ended);
  const double position_s = ended ? length_s : replay->position_s.load();
  if (!place_->hasFocus()) { // else a number is chosen or typed there
    const QSignalBlocker quietPlace(place_);
    place_->setValue(position_s);
  }
  if (line_->isSliderDown()) return;
  const QSignalBlocker quiet(line_);
  line_->setValue(length_s > 0 ? qRound(kSteps * position_s / length_s) : 0);
}

} // namespace palp
