#include "app/gui/touch/ViewPanel.h"

#include "app/gui/window/SpinBoxes.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>

#include <algorithm>

namespace palp {

namespace {

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
  quantity_ = new QComboBox;
  quantity_->setObjectName("quantity");
  for (const Quantity quantity : allQuantities()) {
    const QString unit = QString::fromStdString(quantityUnit(quantity));
    quantity_->addItem(QString::fromStdString(quantityName(quantity)) + (unit.isEmpty() ? "" : " [" + unit + "]"));
  }
  quantity_->setToolTip(tr("Displacements in mm, pressure (compression positive) and stress in MPa; J - 1 is the "
                           "change of volume, 0 in ideal rubber"));
  form->addRow(tr("Colour by"), quantity_);
  warp_ = new QDoubleSpinBox;
  warp_->setObjectName("warp");
  warp_->setRange(0, 1e6);
  warp_->setDecimals(1);
  warp_->setPrefix(tr("x "));
  warp_->setEnabled(false);
  warp_->setKeyboardTracking(false);
  warp_->setToolTip(tr("Factor by which displacements are drawn larger; 1 is true size"));
  automaticWarp_ = new QCheckBox(tr("automatic"));
  automaticWarp_->setObjectName("automaticWarp");
  automaticWarp_->setChecked(true);
  auto* warpRow = new QHBoxLayout;
  warpRow->addWidget(warp_);
  warpRow->addWidget(automaticWarp_);
  form->addRow(tr("Warp"), warpRow);
  clip_ = new QCheckBox(tr("cut at y"));
  clip_->setObjectName("clip");
  clip_->setToolTip(tr("Takes away what lies in front of this plane, to look into the block"));
  clipY_ = new QDoubleSpinBox;
  clipY_->setObjectName("clipY");
  clipY_->setRange(0, 30);
  clipY_->setValue(7.5);
  clipY_->setSuffix(tr(" mm"));
  clipY_->setToolTip(tr("Place of the cut along y [mm]"));
  clipY_->setEnabled(false);
  auto* clipRow = new QHBoxLayout;
  clipRow->addWidget(clip_);
  clipRow->addWidget(clipY_);
  form->addRow(clipRow);
  ghost_ = box(*form, tr("block at rest"), "ghost", true, tr("Edges of the block before the load"));
  electrodes_ = box(*form, tr("electrodes and wires"), "electrodes", true, tr("Looks through the rubber"));
  arrows_ = box(*form, tr("force arrows"), "arrows", true, tr("Forces on the load areas, with their components in N"));
  outlines_ = box(*form, tr("load areas"), "outlines", true, tr("Borders and numbers of the load areas"));
  edges_ = box(*form, tr("mesh"), "edges", false, tr("Edges of the finite elements"));

  connect(quantity_, &QComboBox::currentIndexChanged, this, &ViewPanel::read);
  for (QDoubleSpinBox* spin : {warp_, clipY_}) connect(spin, &QDoubleSpinBox::valueChanged, this, &ViewPanel::read);
  for (QCheckBox* check : {automaticWarp_, clip_, ghost_, electrodes_, arrows_, outlines_, edges_})
    connect(check, &QCheckBox::toggled, this, &ViewPanel::read);
}

void ViewPanel::read() {
  warp_->setDisabled(automaticWarp_->isChecked());
  clipY_->setEnabled(clip_->isChecked());
  if (displaying_) return;
  view_.quantity = allQuantities()[static_cast<std::size_t>(quantity_->currentIndex())];
  view_.warpFactor = automaticWarp_->isChecked() ? std::nullopt : std::optional(warp_->value());
  view_.clipY_mm = clip_->isChecked() ? std::optional(clipY_->value()) : std::nullopt;
  view_.ghost = ghost_->isChecked();
  view_.electrodes = electrodes_->isChecked();
  view_.arrows = arrows_->isChecked();
  view_.outlines = outlines_->isChecked();
  view_.edges = edges_->isChecked();
  emit edited(view_);
}

void ViewPanel::display(const ViewSettings& view, const Eigen::Vector3d& block_mm) {
  displaying_ = true;
  view_ = view;
  const auto& all = allQuantities();
  quantity_->setCurrentIndex(static_cast<int>(std::find(all.begin(), all.end(), view.quantity) - all.begin()));
  automaticWarp_->setChecked(!view.warpFactor);
  if (view.warpFactor) showExactly(*warp_, *view.warpFactor);
  clipY_->setMaximum(block_mm.y());
  clip_->setChecked(view.clipY_mm.has_value());
  if (view.clipY_mm) clipY_->setValue(*view.clipY_mm);
  ghost_->setChecked(view.ghost);
  electrodes_->setChecked(view.electrodes);
  arrows_->setChecked(view.arrows);
  outlines_->setChecked(view.outlines);
  edges_->setChecked(view.edges);
  read();
  displaying_ = false;
}

void ViewPanel::displayWarp(double factor) {
  if (!automaticWarp_->isChecked()) return;
  const QSignalBlocker quiet(warp_);
  warp_->setValue(factor);
}

} // namespace palp
