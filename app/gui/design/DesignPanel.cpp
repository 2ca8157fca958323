#include "app/gui/design/DesignPanel.h"

#include "app/gui/design/LawPanel.h"
#include "app/gui/design/WireScaling.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/Markup.h"
#include "app/gui/widgets/WrappedLabel.h"
#include "model/SensorDesign.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QMap>
#include <QObject>
#include <QSignalBlocker>
#include <QString>
#include <QVBoxLayout>

#include <cmath>
#include <vector>

namespace palp {

namespace {

QString number(double value) {
  return QString::number(value, 'g', 5);
}

/// A design to start from.
struct DesignPreset {
  QString name;
  QString tip;
  SensorDesign design;
};

/// The paper's first; the others differ from it in what their names say.
std::vector<DesignPreset> designPresets() {
  const SensorDesign paper = paperDesign();
  SensorDesign following = paper;
  following.lowerFollowsRubber = true;
  SensorDesign incompressible = paper;
  incompressible.material.poissonRatio = 0.5;
  SensorDesign fine = paper;
  fine.areas.columns = 4;
  fine.areas.rows = 3;
  SensorDesign piezoresistive = paper;
  piezoresistive.pressureLaw = PressureLaw{};
  return {
      {QObject::tr("Paper's sensor"),
       QObject::tr("Sensor of F. Wang et al. 2013 (see Help, About): 30 x 30 x 5 mm, 10 x 30 wires, six load areas"),
       paper},
      {QObject::tr("Lower electrodes follow the rubber"),
       QObject::tr("The paper fixes the lower electrodes. Where they follow the rubber, dR changes by more than half."),
       following},
      {QObject::tr("Incompressible rubber"), QObject::tr("The paper's sensor with a Poisson's ratio of 0.5"),
       incompressible},
      {QObject::tr("Twelve load areas"), QObject::tr("The paper's block with 4 x 3 load areas"), fine},
      {QObject::tr("Resistivity falls with pressure"),
       QObject::tr("The paper's sensor with the pressure law of its Fig. 1"), piezoresistive}};
}

} // namespace

DesignPanel::DesignPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 6, 0);
  derived_ = wrappedLabel("derived");
  derived_->setTextFormat(Qt::RichText);
  derived_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  buildPresets();
  buildFields();
  column->addStretch(1);
}

void DesignPanel::buildPresets() {
  auto* presets = new QComboBox;
  presets->setObjectName("presets");
  presets->setPlaceholderText(tr("Select a preset..."));
  const std::vector<DesignPreset> all = designPresets();
  for (const DesignPreset& preset : all) {
    presets->addItem(preset.name);
    presets->setItemData(presets->count() - 1, preset.tip, Qt::ToolTipRole);
  }
  presets->setCurrentIndex(-1);
  layout()->addWidget(presets);
  auto* limits =
      wrappedLabel("designLimits", "hint",
                   tr("One rectangular block of one hyperelastic rubber: no round or domed bodies, no layers, no creep "
                      "(F1, What Palp cannot do)."));
  layout()->addWidget(limits);
  connect(presets, &QComboBox::activated, this, [this, presets, all](int k) {
    presets->setCurrentIndex(-1);
    const DesignPreset& preset = all[static_cast<std::size_t>(k)];
    emit edited(tr("Select the preset: %1").arg(preset.name), preset.design);
  });
}

void DesignPanel::buildFields() {
  auto* column = static_cast<QVBoxLayout*>(layout());
  QMap<QString, QFormLayout*> groups;
  for (const DesignField& field : designFields()) {
    if (field.group == resistanceGroup()) {
      if (law_ != nullptr) continue; // it has all of them
      law_ = new LawPanel;
      column->addWidget(law_);
      connect(law_, &LawPanel::edited, this, &DesignPanel::read);
      continue;
    }
    if (!groups.contains(field.group)) {
      auto* box = new QGroupBox(field.group);
      groups[field.group] = new QFormLayout(box);
      column->addWidget(box);
    }
    const QString what = tr("Change %1").arg((field.group + " " + field.label).toLower());
    const bool size = field.key.startsWith("block_mm");
    const bool lawOfRubber = field.key == "material.law";
    rows_.add(field, *groups[field.group], [this, what, size, lawOfRubber] {
      if (size)
        readSize(what);
      else if (lawOfRubber)
        readRubberLaw(what);
      else
        read(what);
    });
    if (field.key == "block_mm[2]") addWireScaling(*groups[field.group]);
    if (field.key == "material.density_t_per_mm3") groups[field.group]->addRow(derived_);
    if (field.key == "lower_layer.z_mm") addFollowing(*groups[field.group]);
  }
}

void DesignPanel::addWireScaling(QFormLayout& form) {
  scaleWires_ = checkBox(tr("Scale the wires with the block"), "scaleWires",
                         tr("When on, a change of the block's size moves the wires and electrodes of both layers in "
                            "proportion. When off, they keep their positions."));
  form.addRow(scaleWires_);
  connect(scaleWires_, &QCheckBox::toggled, this, &DesignPanel::scalingChosen);
}

void DesignPanel::displayScaling(bool on) {
  const QSignalBlocker quiet(scaleWires_);
  scaleWires_->setChecked(on);
}

void DesignPanel::addFollowing(QFormLayout& form) {
  follows_ =
      checkBox(tr("Electrodes follow the rubber"), "follows",
               tr("The paper fixes the lower electrodes. Where they follow the rubber, dR changes by more than half."));
  form.addRow(follows_);
  connect(follows_, &QCheckBox::toggled, this, [this] { read(tr("Fix or release the lower electrodes")); });
}

void DesignPanel::display(const SensorDesign& design) {
  displaying_ = true;
  if (design != design_) scaledFrom_.reset(); // not by what is typed here
  design_ = design;
  rows_.display(design);
  rows_.showThoseOf(design);
  law_->display(design);
  follows_->setChecked(design.lowerFollowsRubber);
  showDerived(design);
  displaying_ = false;
}

void DesignPanel::read(const QString& what) {
  if (displaying_) return;
  scaledFrom_.reset();
  SensorDesign next = design_;
  next.lowerFollowsRubber = follows_->isChecked();
  const bool rows = rows_.read(next), law = law_->read(next);
  std::vector<DesignFault> faults;
  if (rows && law) faults = check(next);
  const bool good = rows && law && faults.empty();
  if (good) design_ = next;
  say(faults, good);
  if (!good) return;
  showDerived(next);
  emit edited(what, next);
}

void DesignPanel::readSize(const QString& what) {
  if (!scaleWires_->isChecked()) {
    read(what);
    return;
  }
  if (!scaledFrom_) scaledFrom_ = design_;
  SensorDesign next = design_;
  bool good = rows_.read(next, "block_mm");
  const Eigen::Vector3d size_mm = next.block_mm;
  if (good && (size_mm.array() > 0).all()) next = scaledTo(*scaledFrom_, size_mm);
  const std::vector<DesignFault> faults = good ? check(next) : std::vector<DesignFault>{};
  good = good && faults.empty();
  say(faults, good);
  if (!good) return;
  design_ = next; // before display(), which detects by it who changed the design
  emit edited(tr("%1, and the wires with it").arg(what), next);
}

void DesignPanel::readRubberLaw(const QString& what) {
  if (displaying_) return;
  SensorDesign next = design_; // without what is typed: the other law has its own constants
  if (!rows_.read(next, "material.law")) return;
  display(next);
  emit edited(what, next);
}

void DesignPanel::say(const std::vector<DesignFault>& faults, bool applied) {
  rows_.say(faults, design_, applied);
  law_->say(faults, design_, applied);
}

void DesignPanel::showDerived(const SensorDesign& design) {
  const Material& rubber = design.material;
  const double kappa = rubber.bulkModulus_MPa();
  QString words =
      tr("mu = %1 MPa, kappa = %2, small-strain E = %3 MPa, true small-strain nu = %4")
          .arg(number(rubber.shearModulus_MPa()), std::isfinite(kappa) ? number(kappa) + " MPa" : tr("infinite"),
               number(rubber.smallStrainYoung_MPa()), QString::number(rubber.smallStrainPoissonRatio(), 'g', 8));
  if (rubber == paperDesign().material)
    words += tr("<br><i>The paper's rubber (F. Wang et al. 2013; see Help, About). The paper also prints E = 2.08e5 "
                "N/mm2, which is steel and five orders of magnitude above C10 and C01; that value is not used.</i>");
  if (const auto square = whyNotSquare(design)) words += "<br>" + asWritten(QString::fromStdString(*square));
  derived_->say(words);
}

} // namespace palp
