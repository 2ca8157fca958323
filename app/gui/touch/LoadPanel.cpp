#include "app/gui/touch/LoadPanel.h"

#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QGuiApplication>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr double kMostForce_N = 500;
constexpr int kSliderSteps = 200;
constexpr std::array<const char*, 3> kDirections{"x", "y", "z"};

} // namespace

LoadPanel::LoadPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto* hint = new QLabel(tr("Load areas, seen from above. Click to choose one; Shift-click or the button below takes "
                             "its load away."));
  hint->setWordWrap(true);
  hint->setProperty("role", "hint");
  column->addWidget(hint);
  plan_ = new QGridLayout;
  plan_->setSpacing(2);
  column->addLayout(plan_);
  buildForces();
}

void LoadPanel::buildForces() {
  auto* column = static_cast<QVBoxLayout*>(layout());
  title_ = new QLabel;
  title_->setProperty("role", "title");
  column->addWidget(title_);
  auto* grid = new QGridLayout;
  for (int d = 0; d < 3; ++d) {
    const auto k = static_cast<std::size_t>(d);
    spins_[k] = new QDoubleSpinBox;
    spins_[k]->setObjectName(QString("force_%1").arg(kDirections[k]));
    spins_[k]->setRange(-kMostForce_N, kMostForce_N);
    spins_[k]->setDecimals(3);
    spins_[k]->setSingleStep(0.1);
    spins_[k]->setSuffix(tr(" N"));
    spins_[k]->setKeyboardTracking(false);
    spins_[k]->setToolTip(
        tr("Force along %1 on the area [N]; the slider spans the design's force range").arg(kDirections[k]));
    sliders_[k] = new QSlider(Qt::Horizontal);
    sliders_[k]->setObjectName(QString("slider_%1").arg(kDirections[k]));
    sliders_[k]->setRange(0, kSliderSteps);
    sliders_[k]->setMinimumWidth(90);
    grid->addWidget(new QLabel(QString("F<sub>%1</sub>").arg(kDirections[k])), d, 0);
    grid->addWidget(sliders_[k], d, 1);
    grid->addWidget(spins_[k], d, 2);
    connect(spins_[k], &QDoubleSpinBox::valueChanged, this, [this, d](double value) { setForce(d, value); });
    connect(sliders_[k], &QSlider::valueChanged, this, [this, d](int step) {
      const double low = design_.forceRange.low_N[d];
      const double high = design_.forceRange.high_N[d];
      setForce(d, std::round(1000 * (low + (high - low) * step / kSliderSteps)) / 1000);
    });
  }
  column->addLayout(grid);
  clear_ = new QPushButton(tr("Take this load away"));
  clear_->setObjectName("clearLoad");
  connect(clear_, &QPushButton::clicked, this, [this] { toggleArea(area_, false); });
  column->addWidget(clear_);
}

void LoadPanel::buildPlan() {
  for (QPushButton* button : buttons_) button->deleteLater();
  buttons_.clear();
  for (int area = 0; area < design_.areas.count(); ++area) {
    auto* button = new QPushButton(QString::number(area));
    button->setObjectName(QString("area_%1").arg(area));
    button->setCheckable(true);
    button->setMinimumSize(24, 34);
    connect(button, &QPushButton::clicked, this, [this, area] {
      const bool away = QGuiApplication::keyboardModifiers().testFlag(Qt::ShiftModifier);
      away ? toggleArea(area, false) : chooseArea(area);
    });
    // Seen from above with y up: the first row of areas is the lowest.
    plan_->addWidget(button, design_.areas.rows - 1 - area / design_.areas.columns, area % design_.areas.columns);
    buttons_.push_back(button);
  }
}

AreaLoad* LoadPanel::loadOf(int area) {
  const auto found =
      std::find_if(load_.areas.begin(), load_.areas.end(), [&](const AreaLoad& load) { return load.area == area; });
  return found == load_.areas.end() ? nullptr : &*found;
}

void LoadPanel::display(const SensorDesign& design, const LoadCase& load) {
  const bool otherPlan = buttons_.empty() || !(design.areas == design_.areas);
  design_ = design;
  load_ = load;
  area_ = std::clamp(area_, 0, std::max(0, design.areas.count() - 1));
  if (loadOf(area_) == nullptr && !load_.areas.empty()) area_ = load_.areas.front().area;
  if (otherPlan) buildPlan();
  showForce();
}

void LoadPanel::chooseArea(int area) {
  area_ = area;
  if (loadOf(area) == nullptr) toggleArea(area, true);
  showForce();
  emit areaChosen(area);
}

void LoadPanel::toggleArea(int area, bool loaded) {
  if (loaded == (loadOf(area) != nullptr)) {
    showForce();
    return;
  }
  if (loaded) {
    const Eigen::Vector3d push(0, 0, design_.forceRange.low_N.z() < 0 ? 0.5 * design_.forceRange.low_N.z() : -1);
    load_.areas.push_back({area, push});
  } else {
    std::erase_if(load_.areas, [&](const AreaLoad& load) { return load.area == area; });
    if (!load_.areas.empty()) area_ = load_.areas.front().area;
  }
  showForce();
  emit edited(load_);
}

void LoadPanel::setForce(int direction, double value_N) {
  AreaLoad* load = loadOf(area_);
  if (load == nullptr || load->force_N[direction] == value_N) return;
  load->force_N[direction] = value_N;
  showForce();
  emit edited(load_);
}

void LoadPanel::showForce() {
  const AreaLoad* load = loadOf(area_);
  title_->setText(load != nullptr ? tr("Force on area %1").arg(area_) : tr("No load on area %1").arg(area_));
  clear_->setEnabled(load != nullptr);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto d = static_cast<Eigen::Index>(k);
    const QSignalBlocker quietSpin(spins_[k]);
    const QSignalBlocker quietSlider(sliders_[k]);
    const double value = load != nullptr ? load->force_N[d] : 0;
    const double low = design_.forceRange.low_N[d];
    const double high = design_.forceRange.high_N[d];
    spins_[k]->setEnabled(load != nullptr);
    sliders_[k]->setEnabled(load != nullptr && high > low);
    spins_[k]->setRange(std::min(-kMostForce_N, value), std::max(kMostForce_N, value)); // a file may hold more
    spins_[k]->setValue(value);
    if (high > low)
      sliders_[k]->setValue(
          static_cast<int>(std::lround(std::clamp((value - low) / (high - low), 0.0, 1.0) * kSliderSteps)));
  }
  for (std::size_t area = 0; area < buttons_.size(); ++area) {
    const AreaLoad* its = loadOf(static_cast<int>(area));
    buttons_[area]->setChecked(its != nullptr);
    QFont font = buttons_[area]->font();
    font.setBold(static_cast<int>(area) == area_ && its != nullptr);
    buttons_[area]->setFont(font);
    buttons_[area]->setToolTip(
        its != nullptr
            ? tr("area %1: (%2, %3, %4) N").arg(area).arg(its->force_N.x()).arg(its->force_N.y()).arg(its->force_N.z())
            : tr("area %1: no load").arg(area));
  }
}

} // namespace palp
