#include "app/gui/touch/ViewPanel.h"

#include "app/gui/widgets/MakeWidgets.h"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QStandardItemModel>

#include <algorithm>
#include <cmath>
#include <utility>

namespace palp {

namespace {

constexpr int kNarrow_px = 56; ///< of a number: a box asks for as much as its largest one

} // namespace

ViewPanel::ViewPanel(QWidget* parent)
    : QWidget(parent), fields_([this](const QString& /*what*/, const ViewSettings& view) { emit edited(view); }) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  buildColors(*form);
  lessReference_ = checkBox(tr("Difference from reference design"), "lessKept");
  form->addRow(lessReference_);
  buildScale(*form);
  buildCut(*form);
  const auto addCheck = [&](const QString& text, const char* name, bool ViewSettings::*shown, const QString& tip) {
    form->addRow(fields_.bind(checkBox(text, name, tip), {}, shown));
  };
  addCheck(tr("Largest and smallest value"), "extremes", &ViewSettings::extremes,
           tr("Marks the positions of the largest and the smallest value; in a cut block, those of the visible part"));
  addCheck(tr("Block at rest"), "ghost", &ViewSettings::ghost, tr("Shows the edges of the undeformed block"));
  addCheck(tr("Electrodes and wires"), "electrodes", &ViewSettings::electrodes,
           tr("Makes the rubber transparent to show the electrodes and wires"));
  addCheck(tr("Force arrows"), "arrows", &ViewSettings::arrows,
           tr("Shows the forces of the loads with their components in N"));
  addCheck(tr("Load areas"), "outlines", &ViewSettings::outlines, tr("Shows borders and numbers of the load areas"));
  addCheck(tr("Mesh"), "edges", &ViewSettings::edges, tr("Shows the edges of the finite elements"));

  connect(quantity_, &QComboBox::currentIndexChanged, this, &ViewPanel::chooseQuantity);
  for (QComboBox* list : {colorMap_, cut_}) connect(list, &QComboBox::currentIndexChanged, this, &ViewPanel::read);
  for (QDoubleSpinBox* spin : {warp_, cutAt_, range_[0], range_[1]})
    connect(spin, &QDoubleSpinBox::valueChanged, this, &ViewPanel::read);
  connect(lessReference_, &QCheckBox::toggled, this, &ViewPanel::chooseKept);
  for (QCheckBox* check : {automaticScale_, keepRange_}) connect(check, &QCheckBox::toggled, this, &ViewPanel::read);
}

void ViewPanel::buildColors(QFormLayout& form) {
  quantity_ = new QComboBox;
  quantity_->setObjectName("quantity");
  for (const Quantity quantity : allQuantities()) {
    const QString unit = QString::fromStdString(quantityUnit(quantity));
    quantity_->addItem(QString::fromStdString(quantityName(quantity)) + (unit.isEmpty() ? "" : " [" + unit + "]"));
  }
  quantity_->setToolTip(
      tr("Quantity that colours the block. Displacements are in mm, pressure (compression positive) and Cauchy stress "
         "in MPa; J - 1 is the change of volume, 0 in ideal rubber; principal stretches are 1 at rest."));
  quantity_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  quantity_->setMinimumContentsLength(10);
  form.addRow(tr("Colour by"), quantity_);
  colorMap_ = new QComboBox;
  colorMap_->setObjectName("colorMap");
  colorMap_->addItem(tr("Automatic"));
  for (const auto& [map, name] : kColorMaps.all()) colorMap_->addItem(name);
  colorMap_->setToolTip(tr("Colour map of the quantity. All colour maps are perceptually uniform: equal steps of the "
                           "value look equally large."));
  form.addRow(tr("Colours"), colorMap_);
  auto* row = new QHBoxLayout;
  for (std::size_t k = 0; k < 2; ++k) {
    range_[k] = numberBox(k == 0 ? "rangeFrom" : "rangeTo", {.low = -1e6, .high = 1e6, .decimals = 4, .step = 0.01},
                          tr("Values at the ends of the legend; values beyond have the colour of the end"),
                          k == 0 ? tr("Legend from") : tr("Legend to"));
    range_[k]->setButtonSymbols(QAbstractSpinBox::NoButtons);
    range_[k]->setEnabled(false);
    range_[k]->setMinimumWidth(kNarrow_px);
    row->addWidget(range_[k], 1);
  }
  keepRange_ = checkBox(tr("Fix range"), "keepRange",
                        tr("Keeps the range of the legend when the load changes; otherwise it fits the full load"));
  form.addRow(tr("Legend"), row);
  form.addRow(QString(), keepRange_);
}

void ViewPanel::buildScale(QFormLayout& form) {
  warp_ = numberBox("warp", {.high = 1e6, .decimals = 1},
                    tr("Factor by which displacements are drawn enlarged; 1 is true size"));
  warp_->setPrefix(tr("x "));
  warp_->setEnabled(false);
  warp_->setMinimumWidth(kNarrow_px);
  automaticScale_ = checkBox(tr("Automatic"), "automaticWarp");
  automaticScale_->setChecked(true);
  auto* row = inRow({warp_, automaticScale_});
  form.addRow(new QLabel(tr("Deformation scale"))); // above its row: at its left it would narrow all of them
  form.addRow(QString(), row);
}

void ViewPanel::buildCut(QFormLayout& form) {
  cut_ = choiceBox("cut", {tr("None"), tr("Across x"), tr("Across y"), tr("Across z")},
                   tr("Clips the block at a plane to show its inside. Drag the handle in the view to move it."));
  cutAt_ = numberBox("cutAt", {.unit = tr(" mm")}, tr("Position of the cut [mm]"), tr("Position of the cut"));
  cutAt_->setEnabled(false);
  cutAt_->setMinimumWidth(kNarrow_px);
  form.addRow(tr("Cut"), inRow({{cut_, 1}, {cutAt_, 1}}));
}

void ViewPanel::chooseQuantity() {
  if (displaying_) return;
  const Quantity next = allQuantities()[static_cast<std::size_t>(quantity_->currentIndex())];
  if (quantityUnit(next) != quantityUnit(fields_.settings().quantity)) { // a range in mm means nothing for MPa
    const QSignalBlocker quiet(keepRange_);
    keepRange_->setChecked(false);
  }
  read();
}

void ViewPanel::chooseKept() {
  if (displaying_) return;
  fields_.edit({}, [this](ViewSettings& view) { // a quantity and its difference have a range each
    view.lessReference = lessReference_->isChecked();
    if (view.lessReference) view.uniform = false;
  });
}

void ViewPanel::read() {
  warp_->setDisabled(automaticScale_->isChecked());
  cutAt_->setEnabled(cut_->currentIndex() > 0);
  for (QDoubleSpinBox* end : range_) end->setEnabled(keepRange_->isChecked());
  if (!displaying_) fields_.edit({}, [this](ViewSettings& view) { readInto(view); });
}

void ViewPanel::readInto(ViewSettings& view) const {
  const Quantity before =
      std::exchange(view.quantity, allQuantities()[static_cast<std::size_t>(quantity_->currentIndex())]);
  if (quantityUnit(before) != quantityUnit(view.quantity)) {
    view.colorRange.reset();
    view.differenceRange.reset();
  }
  view.colorMap.reset();
  if (const int map = colorMap_->currentIndex(); map > 0)
    view.colorMap = kColorMaps.all()[static_cast<std::size_t>(map - 1)].first;
  view.shownRange().reset();
  if (keepRange_->isChecked()) {
    const double low = range_[0]->value(), high = range_[1]->value();
    view.shownRange() = {low, std::max(high, low + 1e-4)};
  }
  view.deformationScale = automaticScale_->isChecked() ? std::nullopt : std::optional(warp_->value());
  if (const int axis = cut_->currentIndex() - 1; axis < 0) {
    view.cut.reset();
  } else {
    const bool other = !view.cut || view.cut->axis != axis; // begins in the middle
    view.cut = CutPlane{axis, other ? 0.5 * block_mm_[axis] : cutAt_->value()};
  }
}

void ViewPanel::display(const ViewSettings& view, const Eigen::Vector3d& block_mm, bool somethingKept, bool pressed) {
  displaying_ = true;
  ViewSettings possible = view;
  possible.lessReference = view.lessReference && (view.uniform ? pressed : somethingKept);
  fields_.display(possible);
  block_mm_ = block_mm;
  const auto& all = allQuantities();
  quantity_->setCurrentIndex(static_cast<int>(std::find(all.begin(), all.end(), view.quantity) - all.begin()));
  // Nothing touches without an indenter; one that was chosen with it stays, all 0.
  for (std::size_t k = 0; k < all.size(); ++k)
    qobject_cast<QStandardItemModel*>(quantity_->model())
        ->item(static_cast<int>(k))
        ->setEnabled(pressed || !isOfContact(all[k]));
  int map = 0;
  for (std::size_t k = 0; k < kColorMaps.all().size(); ++k)
    if (view.colorMap == kColorMaps.all()[k].first) map = static_cast<int>(k) + 1;
  colorMap_->setCurrentIndex(map);
  lessReference_->setEnabled(somethingKept);
  lessReference_->setChecked(view.lessReference && somethingKept && !view.uniform);
  lessReference_->setToolTip(
      somethingKept
          ? tr("Colours the block by the difference from the reference design under the same load, point by point")
          : tr("There is no reference design to compare with: Design, Compare, \"Set as reference\""));
  const auto& range = possible.shownRange();
  keepRange_->setChecked(range.has_value());
  if (range)
    for (std::size_t k = 0; k < 2; ++k) showExactly(*range_[k], (*range)[k]);
  automaticScale_->setChecked(!view.deformationScale);
  if (view.deformationScale) showExactly(*warp_, *view.deformationScale);
  cut_->setCurrentIndex(view.cut ? view.cut->axis + 1 : 0);
  if (view.cut) {
    cutAt_->setRange(0, block_mm[view.cut->axis]);
    showExactly(*cutAt_, view.cut->at_mm);
  }
  read();
  displaying_ = false;
}

void ViewPanel::displayDrawn(double deformationScale, const std::array<double, 2>& range) {
  if (automaticScale_->isChecked()) {
    const QSignalBlocker quiet(warp_);
    warp_->setValue(deformationScale);
  }
  if (keepRange_->isChecked()) return;
  for (std::size_t k = 0; k < 2; ++k) {
    const QSignalBlocker quiet(range_[k]);
    // Four digits of what is drawn, however small it is.
    const double size = std::max(std::abs(range[0]), std::abs(range[1]));
    range_[k]->setDecimals(size > 0 ? std::clamp(4 - static_cast<int>(std::floor(std::log10(size))) - 1, 0, 12) : 4);
    range_[k]->setSingleStep(size > 0 ? 0.1 * size : 0.1);
    range_[k]->setValue(range[k]);
  }
}

} // namespace palp
