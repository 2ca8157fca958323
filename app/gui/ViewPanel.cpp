#include "app/gui/ViewPanel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QSignalBlocker>

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
  form->addRow(tr("Colour by"), quantity_);
  warp_ = new QDoubleSpinBox;
  warp_->setObjectName("warp");
  warp_->setRange(0, 1e6);
  warp_->setDecimals(1);
  warp_->setPrefix(tr("x "));
  warp_->setEnabled(false);
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

  connect(automaticWarp_, &QCheckBox::toggled, warp_, &QWidget::setDisabled);
  connect(clip_, &QCheckBox::toggled, clipY_, &QWidget::setEnabled);
  connect(quantity_, &QComboBox::currentIndexChanged, this, &ViewPanel::edited);
  for (QDoubleSpinBox* spin : {warp_, clipY_}) connect(spin, &QDoubleSpinBox::valueChanged, this, &ViewPanel::edited);
  for (QCheckBox* check : {automaticWarp_, clip_, ghost_, electrodes_, arrows_, outlines_, edges_})
    connect(check, &QCheckBox::toggled, this, &ViewPanel::edited);
}

DeformationOptions ViewPanel::options(const DeformationOptions& base) const {
  DeformationOptions options = base;
  options.quantity = allQuantities()[static_cast<std::size_t>(quantity_->currentIndex())];
  options.warpFactor = automaticWarp_->isChecked() ? std::nullopt : std::optional(warp_->value());
  options.clipY_mm = clip_->isChecked() ? std::optional(clipY_->value()) : std::nullopt;
  options.undeformedGhost = ghost_->isChecked();
  options.electrodes = electrodes_->isChecked();
  options.forceArrows = arrows_->isChecked();
  options.areaOutlines = outlines_->isChecked();
  options.meshEdges = edges_->isChecked();
  return options;
}

void ViewPanel::displayWarp(double factor) {
  if (!automaticWarp_->isChecked()) return;
  const QSignalBlocker quiet(warp_);
  warp_->setValue(factor);
}

void ViewPanel::displayBlock(const Eigen::Vector3d& block_mm) {
  const QSignalBlocker quiet(clipY_);
  clipY_->setMaximum(block_mm.y());
}

} // namespace palp
