#include "app/gui/touch/loads/LoadPanel.h"

#include "app/gui/touch/loads/IndenterPanel.h"
#include "app/gui/views/DiscHandle.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/Markup.h"
#include "app/gui/widgets/SpinBoxes.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGridLayout>
#include <QLabel>
#include <QPushButton>
#include <QSignalBlocker>
#include <QSlider>
#include <QVBoxLayout>

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp {

namespace {

constexpr double kMostForce_N = 500;
constexpr int kSliderSteps = 200;
constexpr std::array<const char*, 3> kDirections{"x", "y", "z"};

double hundredth(double value) {
  return std::round(100 * value) / 100;
}

} // namespace

LoadPanel::LoadPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  plan_ = new AreaPlan;
  plan_->setToolTip(tr("Load areas and discs seen from above; click to select, Shift-click to remove the load"));
  column->addWidget(plan_);
  connect(plan_, &AreaPlan::chosen, this, &LoadPanel::choose);
  connect(plan_, &AreaPlan::removed, this, &LoadPanel::takeAway);
  buildChoice();
  buildForces();
  buildDisc();
  indenter_ = new IndenterPanel;
  column->addWidget(indenter_);
  connect(indenter_, &IndenterPanel::edited, this, [this](const Indenter& to) {
    if (chosenIndenter() != nullptr) setIndenter(chosen_.number, to);
  });
  problem_ = textLabel("loadProblem", "problem");
  column->addWidget(problem_);
}

void LoadPanel::buildChoice() {
  auto* column = static_cast<QVBoxLayout*>(layout());
  together_ = textLabel("loadsTogether");
  column->addWidget(together_);
  list_ = choiceBox("loads", {}, tr("All loads of this touch, which act together"), tr("Loads"));
  list_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  list_->setMinimumContentsLength(12);
  column->addWidget(list_);
  connect(list_, &QComboBox::activated, this, [this](int k) {
    if (k < static_cast<int>(places().size())) choose(places()[static_cast<std::size_t>(k)]);
  });
  auto* row = new QHBoxLayout;
  auto* add =
      pushButton(tr("Disc"), "addDisc",
                 tr("Adds a round load anywhere on the top face; in the view, use the tool Press a disc (key D)"));
  clear_ = pushButton(tr("Remove"), "clearLoad", tr("Removes the selected load"));
  auto* press =
      pushButton(tr("Indenter"), "addIndenter",
                 tr("Adds a rigid body that presses anywhere on the top face, with or without friction; in the "
                    "view, use the tool Indenter (key I)"));
  addTo(*row, {add, press, clear_});
  connect(press, &QPushButton::clicked, this, [this] { addIndenter(0.5 * design_.block_mm.head<2>()); });
  column->addLayout(row);
  connect(add, &QPushButton::clicked, this, [this] { addDisc(0.5 * design_.block_mm.head<2>()); });
  connect(clear_, &QPushButton::clicked, this, [this] { takeAway(chosen_); });
  title_ = new QLabel;
  title_->setObjectName("loadTitle");
  title_->setProperty("role", "title");
  column->addWidget(title_);
}

void LoadPanel::buildForces() {
  forces_ = new QWidget;
  auto* grid = new QGridLayout(forces_);
  grid->setContentsMargins(0, 0, 0, 0);
  for (int d = 0; d < 3; ++d) {
    const auto k = static_cast<std::size_t>(d);
    spins_[k] = numberBox(
        QString("force_%1").arg(kDirections[k]),
        {.low = -kMostForce_N, .high = kMostForce_N, .decimals = 3, .step = 0.1, .unit = tr(" N")},
        tr("Force along %1 of the selected load [N]; the slider covers the design's force range").arg(kDirections[k]),
        tr("Force along %1").arg(kDirections[k]));
    sliders_[k] = new QSlider(Qt::Horizontal);
    sliders_[k]->setObjectName(QString("slider_%1").arg(kDirections[k]));
    sliders_[k]->setAccessibleName(spins_[k]->accessibleName());
    sliders_[k]->setRange(0, kSliderSteps);
    sliders_[k]->setMinimumWidth(90);
    grid->addWidget(markupLabel(QString("F<sub>%1</sub>").arg(kDirections[k])), d, 0);
    grid->addWidget(sliders_[k], d, 1);
    grid->addWidget(spins_[k], d, 2);
    connect(spins_[k], &QDoubleSpinBox::valueChanged, this, [this, d](double value) { setForce(d, value); });
    connect(sliders_[k], &QSlider::valueChanged, this, [this, d](int step) {
      const double low = design_.forceRange.low_N[d];
      const double high = design_.forceRange.high_N[d];
      setForce(d, std::round(1000 * (low + (high - low) * step / kSliderSteps)) / 1000);
    });
  }
  layout()->addWidget(forces_);
}

void LoadPanel::buildDisc() {
  disc_ = new QWidget;
  auto* grid = new QGridLayout(disc_);
  grid->setContentsMargins(0, 0, 0, 0);
  const std::array<QString, 3> labels{tr("Centre x"), tr("Centre y"), tr("Radius")};
  constexpr std::array<const char*, 3> kNames{"discX", "discY", "discRadius"};
  for (int k = 0; k < 3; ++k) {
    auto* spin = new NumberBox;
    discSpins_[static_cast<std::size_t>(k)] = spin;
    spin->setObjectName(kNames[static_cast<std::size_t>(k)]);
    spin->setAccessibleName(tr("Disc, %1").arg(labels[static_cast<std::size_t>(k)]));
    spin->setDecimals(2);
    spin->setSingleStep(0.5);
    spin->setSuffix(tr(" mm"));
    spin->setKeyboardTracking(false);
    spin->setToolTip(tr("Position and size of the disc; it is kept inside the top face"));
    grid->addWidget(new QLabel(labels[static_cast<std::size_t>(k)]), k, 0);
    grid->addWidget(spin, k, 1);
    connect(spin, &QDoubleSpinBox::valueChanged, this, &LoadPanel::readDisc);
  }
  static_cast<QVBoxLayout*>(layout())->addWidget(disc_);
}

Eigen::Vector3d LoadPanel::firstPush_N() const {
  return {0, 0, design_.forceRange.low_N.z() < 0 ? 0.5 * design_.forceRange.low_N.z() : -1};
}

std::vector<LoadPlace> LoadPanel::places() const {
  std::vector<LoadPlace> all;
  for (const AreaLoad& load : load_.areas) all.push_back({LoadKind::Area, load.area});
  for (std::size_t k = 0; k < load_.patches.size(); ++k) all.push_back({LoadKind::Disc, static_cast<int>(k)});
  for (std::size_t k = 0; k < load_.indenters.size(); ++k) all.push_back({LoadKind::Indenter, static_cast<int>(k)});
  return all;
}

Eigen::Vector3d* LoadPanel::forceOf(const LoadPlace& place) {
  const auto k = static_cast<std::size_t>(place.number);
  if (place.kind == LoadKind::Disc) return k < load_.patches.size() ? &load_.patches[k].force_N : nullptr;
  if (place.kind == LoadKind::Indenter) {
    Press* press = k < load_.indenters.size() ? std::get_if<Press>(&load_.indenters[k].control) : nullptr;
    return press != nullptr ? &press->force_N : nullptr;
  }
  for (AreaLoad& load : load_.areas)
    if (load.area == place.number) return &load.force_N;
  return nullptr;
}

QString LoadPanel::name(const LoadPlace& place) const {
  switch (place.kind) {
  case LoadKind::Area:
    return tr("area %1").arg(place.number);
  case LoadKind::Disc:
    return tr("disc %1").arg(place.number);
  case LoadKind::Indenter:
    return tr("indenter %1").arg(place.number);
  }
  return {};
}

Indenter* LoadPanel::chosenIndenter() {
  const auto k = static_cast<std::size_t>(chosen_.number);
  return chosen_.kind == LoadKind::Indenter && k < load_.indenters.size() ? &load_.indenters[k] : nullptr;
}

bool LoadPanel::bears(const LoadPlace& place) const {
  const std::vector<LoadPlace> all = places();
  return std::find(all.begin(), all.end(), place) != all.end();
}

void LoadPanel::display(const SensorDesign& design, const LoadCase& load) {
  design_ = design;
  load_ = load;
  if (chosen_.kind == LoadKind::Area)
    chosen_.number = std::clamp(chosen_.number, 0, std::max(0, design_.areas.count() - 1));
  chooseWhatIsThere();
  showLoad();
}

void LoadPanel::choose(const LoadPlace& place) {
  chosen_ = place;
  if (!bears(place) && place.kind == LoadKind::Area) {
    load_.areas.push_back({place.number, firstPush_N()});
    showLoad();
    emit edited(tr("Load area %1").arg(place.number), load_);
    return;
  }
  showLoad();
}

void LoadPanel::addDisc(const Eigen::Vector2d& centre_mm) {
  const double radius_mm = hundredth(std::min(2.5, 0.2 * design_.block_mm.head<2>().minCoeff()));
  const Eigen::Vector2d centre(hundredth(centre_mm.x()), hundredth(centre_mm.y()));
  load_.patches.push_back(insideFace({centre, radius_mm, firstPush_N()}, design_.block_mm));
  chosen_ = {LoadKind::Disc, static_cast<int>(load_.patches.size()) - 1};
  showLoad();
  emit edited(tr("Add disc %1").arg(chosen_.number), load_);
}

void LoadPanel::changeDisc(int disc, const Eigen::Vector2d& centre_mm, double radius_mm) {
  const auto k = static_cast<std::size_t>(disc);
  if (disc < 0 || k >= load_.patches.size()) return;
  chosen_ = {LoadKind::Disc, disc};
  const PatchLoad next = insideFace({centre_mm, radius_mm, load_.patches[k].force_N}, design_.block_mm);
  const bool other = next != load_.patches[k];
  load_.patches[k] = next;
  showLoad();
  if (other) emit edited(tr("Change disc %1").arg(disc), load_);
}

void LoadPanel::addIndenter(const Eigen::Vector2d& place_mm) {
  Indenter next = last_;
  next.place_mm = {hundredth(place_mm.x()), hundredth(place_mm.y())};
  load_.indenters.push_back(next);
  chosen_ = {LoadKind::Indenter, static_cast<int>(load_.indenters.size()) - 1};
  showLoad();
  emit edited(tr("Add indenter %1").arg(chosen_.number), load_);
}

void LoadPanel::moveIndenter(int indenter, const Eigen::Vector2d& place_mm) {
  const auto k = static_cast<std::size_t>(indenter);
  if (indenter < 0 || k >= load_.indenters.size()) return;
  Indenter next = load_.indenters[k];
  next.place_mm = place_mm;
  setIndenter(indenter, next);
}

void LoadPanel::sizeIndenter(int indenter, double radius_mm) {
  const auto k = static_cast<std::size_t>(indenter);
  if (indenter < 0 || k >= load_.indenters.size() || load_.indenters[k].shape == IndenterShape::Plane) return;
  Indenter next = load_.indenters[k];
  next.radius_mm = std::max(radius_mm, next.rim_mm);
  setIndenter(indenter, next);
}

void LoadPanel::setIndenter(int indenter, const Indenter& to) {
  chosen_ = {LoadKind::Indenter, indenter};
  const bool other = std::exchange(load_.indenters[static_cast<std::size_t>(indenter)], to) != to;
  last_ = to;
  showLoad();
  if (other) emit edited(tr("Change indenter %1").arg(indenter), load_);
}

void LoadPanel::chooseWhatIsThere() {
  if (!bears(chosen_) && !places().empty()) chosen_ = places().front();
  if (!bears(chosen_)) chosen_.kind = LoadKind::Area;
}

void LoadPanel::takeAway(const LoadPlace& place) {
  if (!bears(place)) return;
  const QString what = tr("Remove the load of %1").arg(name(place));
  switch (place.kind) {
  case LoadKind::Area:
    std::erase_if(load_.areas, [&](const AreaLoad& load) { return load.area == place.number; });
    break;
  case LoadKind::Disc:
    load_.patches.erase(load_.patches.begin() + place.number);
    break;
  case LoadKind::Indenter:
    load_.indenters.erase(load_.indenters.begin() + place.number);
    break;
  }
  if (!places().empty())
    chosen_ = places().front();
  else
    chosen_.kind = LoadKind::Area;
  showLoad();
  emit edited(what, load_);
}

void LoadPanel::pressDisc(const Eigen::Vector2d& place_mm) {
  for (std::size_t k = load_.patches.size(); k-- > 0;)
    if ((place_mm - load_.patches[k].centre_mm).norm() <= load_.patches[k].radius_mm)
      return takeAway({LoadKind::Disc, static_cast<int>(k)});
  addDisc(place_mm);
}

void LoadPanel::pressIndenter(const Eigen::Vector2d& place_mm) {
  for (std::size_t k = load_.indenters.size(); k-- > 0;)
    if ((place_mm - load_.indenters[k].place_mm).norm() <= load_.indenters[k].radius_mm)
      return takeAway({LoadKind::Indenter, static_cast<int>(k)});
  addIndenter(place_mm);
}

void LoadPanel::setForce(int direction, double value_N) {
  Eigen::Vector3d* force_N = forceOf(chosen_);
  if (force_N == nullptr || (*force_N)[direction] == value_N) return;
  (*force_N)[direction] = value_N;
  if (const Indenter* indenter = chosenIndenter()) last_ = *indenter;
  showLoad();
  emit edited(tr("Change the load on %1").arg(name(chosen_)), load_);
}

void LoadPanel::readDisc() {
  if (chosen_.kind == LoadKind::Disc)
    changeDisc(chosen_.number, {discSpins_[0]->value(), discSpins_[1]->value()}, discSpins_[2]->value());
}

void LoadPanel::showLoad() {
  plan_->display(design_, load_, chosen_);
  const std::vector<LoadPlace> all = places();
  constexpr std::size_t kNamed = 6;
  QStringList names;
  for (std::size_t k = 0; k < std::min(all.size(), kNamed); ++k) names << name(all[k]);
  if (all.size() > kNamed) names << tr("%1 more").arg(all.size() - kNamed);
  together_->setText(tr("%1 loads act together: %2").arg(all.size()).arg(names.join(", ")));
  together_->setVisible(all.size() > 1); // the list shows one
  list_->clear();
  int now = -1;
  for (const LoadPlace& place : places()) {
    if (place == chosen_) now = list_->count();
    const Eigen::Vector3d* force_N = forceOf(place);
    list_->addItem(
        name(place) + ": " +
        (force_N != nullptr
             ? QString("(%1, %2, %3) N").arg(force_N->x()).arg(force_N->y()).arg(force_N->z())
             : tr("%1 mm deep").arg(load_.indenters[static_cast<std::size_t>(place.number)].motion()->depth_mm)));
  }
  list_->setCurrentIndex(now);
  list_->setEnabled(list_->count() > 0);
  const bool there = bears(chosen_), disc = there && chosen_.kind == LoadKind::Disc;
  const Indenter* indenter = chosenIndenter();
  title_->setText(indenter != nullptr ? tr("Indenter %1").arg(chosen_.number)
                  : there             ? tr("Force on %1").arg(name(chosen_))
                                      : tr("No load on %1").arg(name(chosen_)));
  clear_->setEnabled(there);
  disc_->setVisible(disc);
  forces_->setVisible(indenter == nullptr || indenter->press() != nullptr);
  indenter_->setVisible(indenter != nullptr);
  if (indenter != nullptr) indenter_->display(*indenter, design_);
  const auto wrong = whyInvalid(load_, design_);
  problem_->setVisible(wrong.has_value());
  problem_->setText(wrong ? tr("Not applied: %1").arg(QString::fromStdString(*wrong)) : QString());
  if (disc) {
    const PatchLoad& its = load_.patches[static_cast<std::size_t>(chosen_.number)];
    const std::array<double, 3> values{its.centre_mm.x(), its.centre_mm.y(), its.radius_mm};
    const std::array<double, 3> most{design_.block_mm.x(), design_.block_mm.y(),
                                     0.5 * design_.block_mm.head<2>().minCoeff()};
    for (std::size_t k = 0; k < 3; ++k) {
      const QSignalBlocker quiet(discSpins_[k]);
      discSpins_[k]->setRange(k == 2 ? kSmallestDisc_mm : 0, most[k]);
      showExactly(*discSpins_[k], values[k]);
    }
  }
  showForce();
}

void LoadPanel::showForce() {
  const Eigen::Vector3d* force_N = forceOf(chosen_);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto d = static_cast<Eigen::Index>(k);
    const QSignalBlocker quietSpin(spins_[k]);
    const QSignalBlocker quietSlider(sliders_[k]);
    const double value = force_N != nullptr ? (*force_N)[d] : 0;
    const double low = design_.forceRange.low_N[d];
    const double high = design_.forceRange.high_N[d];
    spins_[k]->setEnabled(force_N != nullptr);
    sliders_[k]->setEnabled(force_N != nullptr && high > low);
    spins_[k]->setRange(std::min(-kMostForce_N, value), std::max(kMostForce_N, value)); // a file may hold more
    spins_[k]->setValue(value);
    if (high > low)
      sliders_[k]->setValue(
          static_cast<int>(std::lround(std::clamp((value - low) / (high - low), 0.0, 1.0) * kSliderSteps)));
  }
}

} // namespace palp
