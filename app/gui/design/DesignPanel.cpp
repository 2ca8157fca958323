#include "app/gui/design/DesignPanel.h"

#include "app/gui/design/DesignFields.h"
#include "app/gui/design/DesignPresets.h"
#include "app/gui/design/WireScaling.h"
#include "app/gui/widgets/WrappedLabel.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QMap>
#include <QStyle>
#include <QVBoxLayout>

#include <cmath>

namespace palp {

namespace {

QString number(double value) {
  return QString::number(value, 'g', 5);
}

WrappedLabel* problemLabel() {
  auto* label = new WrappedLabel;
  label->setProperty("role", "problem");
  label->hide();
  return label;
}

/// Marked with a red frame.
void markWrong(QLineEdit& edit, bool wrong) {
  if (edit.property("wrong").toBool() == wrong) return;
  edit.setProperty("wrong", wrong);
  edit.style()->unpolish(&edit);
  edit.style()->polish(&edit);
}

} // namespace

DesignPanel::DesignPanel(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 6, 0);
  derived_ = new WrappedLabel;
  derived_->setObjectName("derived");
  derived_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  buildPresets();
  buildFields();
  buildSwitches();
  column->addStretch(1);
}

void DesignPanel::buildPresets() {
  auto* presets = new QComboBox;
  presets->setObjectName("presets");
  presets->setPlaceholderText(tr("Start from a preset..."));
  const std::vector<DesignPreset> all = designPresets();
  for (const DesignPreset& preset : all) {
    presets->addItem(preset.name);
    presets->setItemData(presets->count() - 1, preset.tip, Qt::ToolTipRole);
  }
  presets->setCurrentIndex(-1);
  layout()->addWidget(presets);
  connect(presets, &QComboBox::activated, this, [this, presets, all](int k) {
    presets->setCurrentIndex(-1);
    const DesignPreset& preset = all[static_cast<std::size_t>(k)];
    emit edited(tr("Take the preset: %1").arg(preset.name), preset.design);
  });
}

void DesignPanel::buildFields() {
  auto* column = static_cast<QVBoxLayout*>(layout());
  QMap<QString, QFormLayout*> groups;
  for (const DesignField& field : designFields()) {
    if (!groups.contains(field.group)) {
      auto* box = new QGroupBox(field.group);
      groups[field.group] = new QFormLayout(box);
      column->addWidget(box);
    }
    Row row{new QLineEdit, problemLabel()};
    row.edit->setObjectName(field.key);
    row.edit->setToolTip(field.tip + QString("<br><i>%1</i>").arg(field.key));
    groups[field.group]->addRow(field.unit.isEmpty() ? field.label : field.label + " [" + field.unit + "]", row.edit);
    row.problem->setObjectName(field.key + " problem");
    row.edit->setAccessibleName(field.group + ", " + field.label);
    groups[field.group]->addRow(row.problem);
    const QString what = tr("Change %1").arg((field.group + " " + field.label).toLower());
    const bool size = field.key.startsWith("block_mm");
    connect(row.edit, &QLineEdit::textEdited, this, [this, what, size] { size ? readSize(what) : read(what); });
    rows_.push_back(row);
    if (field.key == "block_mm[2]") addWireScaling(*groups[field.group]);
    if (field.key == "material.density_t_per_mm3") groups[field.group]->addRow(derived_);
  }
}

void DesignPanel::addWireScaling(QFormLayout& form) {
  scaleWires_ = new QCheckBox(tr("scale the wires with the block"));
  scaleWires_->setObjectName("scaleWires");
  scaleWires_->setToolTip(tr("Another size of the block takes both layers of wires and electrodes with it, each in the "
                             "same share of the block as before; else they stay where they are"));
  form.addRow(scaleWires_);
}

void DesignPanel::buildSwitches() {
  auto* box = new QGroupBox(tr("Switches"));
  auto* form = new QFormLayout(box);
  follows_ = new QCheckBox(tr("lower electrodes follow the rubber"));
  follows_->setObjectName("follows");
  follows_->setToolTip(tr("The paper holds them still; where they follow, dR changes by more than half"));
  form->addRow(follows_);
  law_ = new QCheckBox(tr("resistivity falls with pressure (Fig. 1)"));
  law_->setObjectName("pressureLaw");
  law_->setToolTip(tr("g(p) = g (1 + max(p, 0) / p0)^(-n); the starting values are assumed, the figure prints none"));
  form->addRow(law_);
  p0_ = new QLineEdit;
  p0_->setObjectName("p0");
  exponent_ = new QLineEdit;
  exponent_->setObjectName("exponent");
  form->addRow(tr("p0 [MPa]"), p0_);
  form->addRow(tr("n"), exponent_);
  lawProblem_ = problemLabel();
  form->addRow(lawProblem_);
  static_cast<QVBoxLayout*>(layout())->addWidget(box);
  connect(follows_, &QCheckBox::toggled, this, [this] { read(tr("Hold or free the lower electrodes")); });
  connect(law_, &QCheckBox::toggled, this, [this] { read(tr("Change the pressure law")); });
  for (QLineEdit* edit : {p0_, exponent_})
    connect(edit, &QLineEdit::textEdited, this, [this] { read(tr("Change the pressure law")); });
}

void DesignPanel::display(const SensorDesign& design) {
  displaying_ = true;
  if (design != design_) scaledFrom_.reset(); // not by what is typed here
  design_ = design;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    SensorDesign written = design;
    const DesignField& field = designFields()[k];
    const bool same = field.set(written, rows_[k].edit->text()).isEmpty() && written == design;
    if (!same) rows_[k].edit->setText(field.text(design));
    rows_[k].problem->say({});
    markWrong(*rows_[k].edit, false);
    rows_[k].edit->setProperty("unapplied", false);
    rows_[k].edit->setCursorPosition(same ? rows_[k].edit->cursorPosition() : 0);
  }
  follows_->setChecked(design.lowerFollowsRubber);
  law_->setChecked(design.pressureLaw.has_value());
  const PressureLaw law = design.pressureLaw.value_or(PressureLaw{});
  for (auto [edit, value] : {std::pair{p0_, law.p0_MPa}, std::pair{exponent_, law.exponent}}) {
    if (edit->text().toDouble() != value || edit->text().isEmpty()) edit->setText(QString::number(value));
    edit->setEnabled(design.pressureLaw.has_value());
  }
  lawProblem_->say({});
  showDerived(design);
  displaying_ = false;
}

void DesignPanel::read(const QString& what) {
  if (displaying_) return;
  scaledFrom_.reset();
  SensorDesign next = design_;
  bool good = true;
  std::vector<QString> sentences(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    sentences[k] = designFields()[k].set(next, rows_[k].edit->text());
    good = good && sentences[k].isEmpty();
  }
  next.lowerFollowsRubber = follows_->isChecked();
  next.pressureLaw.reset();
  if (law_->isChecked()) {
    const PressureLaw standard;
    bool goodP0 = false;
    bool goodExponent = false;
    const PressureLaw law{p0_->text().toDouble(&goodP0), exponent_->text().toDouble(&goodExponent)};
    next.pressureLaw = law_->isChecked() && p0_->isEnabled() ? law : standard;
    good = good && (!p0_->isEnabled() || (goodP0 && goodExponent));
  }
  QString lawSentence;
  if (good)
    for (const DesignFault& problem : check(next)) {
      good = false;
      const QString key = QString::fromStdString(problem.key);
      const QString sentence = QString::fromStdString(problem.sentence);
      if (key.startsWith("resistance.pressure_law")) lawSentence = sentence;
      for (std::size_t k = 0; k < rows_.size(); ++k)
        if (key.startsWith(designFields()[k].key) && sentences[k].isEmpty()) sentences[k] = sentence;
    }
  sayUnderFields(sentences, good);
  lawProblem_->say(lawSentence);
  if (!good) return;
  design_ = next;
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
  bool good = true;
  std::vector<QString> sentences(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (!designFields()[k].key.startsWith("block_mm")) continue;
    sentences[k] = designFields()[k].set(next, rows_[k].edit->text());
    good = good && sentences[k].isEmpty();
  }
  const Eigen::Vector3d size_mm = next.block_mm;
  if (good && (size_mm.array() > 0).all()) next = scaledTo(*scaledFrom_, size_mm);
  for (const DesignFault& problem : good ? check(next) : std::vector<DesignFault>{}) {
    good = false;
    for (std::size_t k = 0; k < rows_.size(); ++k)
      if (QString::fromStdString(problem.key).startsWith(designFields()[k].key) && sentences[k].isEmpty())
        sentences[k] = QString::fromStdString(problem.sentence);
  }
  sayUnderFields(sentences, good);
  if (!good) return;
  design_ = next; // before display(), which tells by it who changed the design
  emit edited(tr("%1, and the wires with it").arg(what), next);
}

void DesignPanel::sayUnderFields(const std::vector<QString>& sentences, bool applied) {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const DesignField& field = designFields()[k];
    SensorDesign written = design_;
    const bool inUse = field.set(written, rows_[k].edit->text()).isEmpty() && written == design_;
    QString sentence = sentences[k];
    if (!applied && !inUse) {
      const QString used = field.text(design_) + (field.unit.isEmpty() ? QString() : " " + field.unit);
      sentence = sentence.isEmpty() ? tr("Not applied while another field is wrong; in use is %1.").arg(used)
                                    : tr("%1. In use is still %2.").arg(sentence, used);
    }
    rows_[k].problem->say(sentence);
    markWrong(*rows_[k].edit, !sentence.isEmpty());
    rows_[k].edit->setProperty("unapplied", !applied);
  }
}

void DesignPanel::showDerived(const SensorDesign& design) {
  const Material& rubber = design.material;
  const double kappa = rubber.bulkModulus_MPa();
  QString words =
      tr("mu = %1 MPa, kappa = %2, small-strain E = %3 MPa, true small-strain nu = %4")
          .arg(number(rubber.shearModulus_MPa()), std::isfinite(kappa) ? number(kappa) + " MPa" : tr("infinite"),
               number(rubber.smallStrainYoung_MPa()), QString::number(rubber.smallStrainPoissonRatio(), 'g', 8));
  if (rubber == paperDesign().material)
    words += tr("<br><i>The paper also prints E = 2.08e5 N/mm2: steel, five orders of magnitude off c10 and c01; it is "
                "not used.</i>");
  if (const auto square = whyNotSquare(design)) words += "<br>" + QString::fromStdString(*square);
  derived_->say(words);
}

} // namespace palp
