#include "app/gui/touch/ViewPanel.h"

#include "app/gui/widgets/SpinBoxes.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QStandardItemModel>

#include <algorithm>
#include <cmath>

namespace palp {

namespace {

constexpr int kNarrow_px = 56; ///< of a number: a box asks for as much as its largest one

QCheckBox* box(QFormLayout& form, const QString& text, const char* name, bool on, const QString& tip) {
  auto* check = new QCheckBox(text);
  check->setObjectName(name);
  check->setChecked(on);
  check->setToolTip(tip);
  form.addRow(check);
  return check;
}

} // namespace

ViewPanel::ViewPanel(QWidget* parent) : QWidget(parent) {
  auto* form = new QFormLayout(this);
  form->setContentsMargins(0, 0, 0, 0);
  buildColors(*form);
  lessKept_ = box(*form, tr("Difference from reference design"), "lessKept", false, {});
  buildWarp(*form);
  buildCut(*form);
  extremes_ =
      box(*form, tr("Largest and smallest value"), "extremes", false,
          tr("Marks the positions of the largest and the smallest value; in a cut block, those of the visible part"));
  ghost_ = box(*form, tr("Block at rest"), "ghost", true, tr("Shows the edges of the undeformed block"));
  electrodes_ = box(*form, tr("Electrodes and wires"), "electrodes", true,
                    tr("Makes the rubber transparent to show the electrodes and wires"));
  arrows_ =
      box(*form, tr("Force arrows"), "arrows", true, tr("Shows the forces of the loads with their components in N"));
  outlines_ = box(*form, tr("Load areas"), "outlines", true, tr("Shows borders and numbers of the load areas"));
  edges_ = box(*form, tr("Mesh"), "edges", false, tr("Shows the edges of the finite elements"));

  connect(quantity_, &QComboBox::currentIndexChanged, this, &ViewPanel::chooseQuantity);
  for (QComboBox* list : {colorMap_, cut_}) connect(list, &QComboBox::currentIndexChanged, this, &ViewPanel::read);
  for (QDoubleSpinBox* spin : {warp_, cutAt_, range_[0], range_[1]})
    connect(spin, &QDoubleSpinBox::valueChanged, this, &ViewPanel::read);
  connect(lessKept_, &QCheckBox::toggled, this, &ViewPanel::chooseKept);
  for (QCheckBox* check : {automaticWarp_, keepRange_, extremes_, ghost_, electrodes_, arrows_, outlines_, edges_})
    connect(check, &QCheckBox::toggled, this, &ViewPanel::read);
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
    range_[k] = new NumberBox;
    range_[k]->setObjectName(k == 0 ? "rangeFrom" : "rangeTo");
    range_[k]->setAccessibleName(k == 0 ? tr("Legend from") : tr("Legend to"));
    range_[k]->setToolTip(tr("Values at the ends of the legend; values beyond have the colour of the end"));
    range_[k]->setDecimals(4);
    range_[k]->setRange(-1e6, 1e6);
    range_[k]->setSingleStep(0.01);
    range_[k]->setButtonSymbols(QAbstractSpinBox::NoButtons);
    range_[k]->setKeyboardTracking(false);
    range_[k]->setEnabled(false);
    range_[k]->setMinimumWidth(kNarrow_px);
    row->addWidget(range_[k], 1);
  }
  keepRange_ = new QCheckBox(tr("Fix range"));
  keepRange_->setObjectName("keepRange");
  keepRange_->setToolTip(tr("Keeps the range of the legend when the load changes; otherwise it fits the full load"));
  form.addRow(tr("Legend"), row);
  form.addRow(QString(), keepRange_);
}

void ViewPanel::buildWarp(QFormLayout& form) {
  warp_ = new NumberBox;
  warp_->setObjectName("warp");
  warp_->setRange(0, 1e6);
  warp_->setDecimals(1);
  warp_->setPrefix(tr("x "));
  warp_->setEnabled(false);
  warp_->setMinimumWidth(kNarrow_px);
  warp_->setKeyboardTracking(false);
  warp_->setToolTip(tr("Factor by which displacements are drawn enlarged; 1 is true size"));
  automaticWarp_ = new QCheckBox(tr("Automatic"));
  automaticWarp_->setObjectName("automaticWarp");
  automaticWarp_->setChecked(true);
  auto* row = new QHBoxLayout;
  row->addWidget(warp_);
  row->addWidget(automaticWarp_);
  form.addRow(new QLabel(tr("Deformation scale"))); // above its row: at its left it would narrow all of them
  form.addRow(QString(), row);
}

void ViewPanel::buildCut(QFormLayout& form) {
  cut_ = new QComboBox;
  cut_->setObjectName("cut");
  cut_->addItems({tr("None"), tr("Across x"), tr("Across y"), tr("Across z")});
  cut_->setToolTip(tr("Clips the block at a plane to show its inside. Drag the handle in the view to move it."));
  cutAt_ = new NumberBox;
  cutAt_->setObjectName("cutAt");
  cutAt_->setAccessibleName(tr("Position of the cut"));
  cutAt_->setSuffix(tr(" mm"));
  cutAt_->setKeyboardTracking(false);
  cutAt_->setToolTip(tr("Position of the cut [mm]"));
  cutAt_->setEnabled(false);
  cutAt_->setMinimumWidth(kNarrow_px);
  auto* row = new QHBoxLayout;
  row->addWidget(cut_, 1);
  row->addWidget(cutAt_, 1);
  form.addRow(tr("Cut"), row);
}

void ViewPanel::chooseQuantity() {
  if (displaying_) return;
  const Quantity next = allQuantities()[static_cast<std::size_t>(quantity_->currentIndex())];
  // A range in mm means nothing for MPa.
  if (quantityUnit(next) != quantityUnit(view_.quantity)) {
    view_.colorRange.reset();
    view_.differenceRange.reset();
    const QSignalBlocker quiet(keepRange_);
    keepRange_->setChecked(false);
  }
  read();
}

void ViewPanel::chooseKept() {
  if (displaying_) return;
  ViewSettings next = view_; // the range of a quantity means little for a difference: each has its own
  next.lessKept = lessKept_->isChecked();
  if (next.lessKept) next.uniform = false;
  emit edited(next);
}

void ViewPanel::read() {
  warp_->setDisabled(automaticWarp_->isChecked());
  cutAt_->setEnabled(cut_->currentIndex() > 0);
  for (QDoubleSpinBox* end : range_) end->setEnabled(keepRange_->isChecked());
  if (displaying_) return;
  view_.quantity = allQuantities()[static_cast<std::size_t>(quantity_->currentIndex())];
  view_.colorMap.reset();
  if (const int map = colorMap_->currentIndex(); map > 0)
    view_.colorMap = kColorMaps.all()[static_cast<std::size_t>(map - 1)].first;
  view_.shownRange().reset();
  if (keepRange_->isChecked()) {
    const double low = range_[0]->value(), high = range_[1]->value();
    view_.shownRange() = {low, std::max(high, low + 1e-4)};
  }
  view_.warpFactor = automaticWarp_->isChecked() ? std::nullopt : std::optional(warp_->value());
  if (const int axis = cut_->currentIndex() - 1; axis < 0) {
    view_.cut.reset();
  } else {
    const bool other = !view_.cut || view_.cut->axis != axis; // begins in the middle
    view_.cut = CutPlane{axis, other ? 0.5 * block_mm_[axis] : cutAt_->value()};
  }
  view_.extremes = extremes_->isChecked();
  view_.ghost = ghost_->isChecked();
  view_.electrodes = electrodes_->isChecked();
  view_.arrows = arrows_->isChecked();
  view_.outlines = outlines_->isChecked();
  view_.edges = edges_->isChecked();
  emit edited(view_);
}

void ViewPanel::display(const ViewSettings& view, const Eigen::Vector3d& block_mm, bool somethingKept, bool pressed) {
  displaying_ = true;
  view_ = view;
  view_.lessKept = view.lessKept && (view.uniform ? pressed : somethingKept);
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
  lessKept_->setEnabled(somethingKept);
  lessKept_->setChecked(view.lessKept && somethingKept && !view.uniform);
  lessKept_->setToolTip(
      somethingKept
          ? tr("Colours the block by the difference from the reference design under the same load, point by point")
          : tr("There is no reference design to compare with: Design, Compare, \"Set as reference\""));
  const auto& range = view_.shownRange();
  keepRange_->setChecked(range.has_value());
  if (range)
    for (std::size_t k = 0; k < 2; ++k) showExactly(*range_[k], (*range)[k]);
  automaticWarp_->setChecked(!view.warpFactor);
  if (view.warpFactor) showExactly(*warp_, *view.warpFactor);
  cut_->setCurrentIndex(view.cut ? view.cut->axis + 1 : 0);
  if (view.cut) {
    cutAt_->setRange(0, block_mm[view.cut->axis]);
    showExactly(*cutAt_, view.cut->at_mm);
  }
  extremes_->setChecked(view.extremes);
  ghost_->setChecked(view.ghost);
  electrodes_->setChecked(view.electrodes);
  arrows_->setChecked(view.arrows);
  outlines_->setChecked(view.outlines);
  edges_->setChecked(view.edges);
  read();
  displaying_ = false;
}

void ViewPanel::displayDrawn(double warpFactor, const std::array<double, 2>& range) {
  if (automaticWarp_->isChecked()) {
    const QSignalBlocker quiet(warp_);
    warp_->setValue(warpFactor);
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
