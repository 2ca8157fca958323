#include "app/gui/touch/LawBar.h"

#include "app/gui/design/DesignFields.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSignalBlocker>

#include <utility>

namespace palp {

LawBar::LawBar(QWidget* parent) : QWidget(parent), otherLaw_(FieldLaw{}) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  law_ = add("resistance.law");
  law_->setObjectName("lawBar");
  readout_ = add("resistance.readout");
  readout_->setObjectName("readoutBar");
  row->addWidget(law_);
  row->addWidget(readout_);
}

QComboBox* LawBar::add(const QString& key) {
  const DesignField& field = designField(key);
  auto* box = new QComboBox;
  for (const DesignChoice& choice : field.choices) {
    box->addItem(choice.words);
    box->setItemData(box->count() - 1, choice.tip, Qt::ToolTipRole);
  }
  box->setToolTip(field.tip + tr("; its parameters are on the Design scene"));
  box->setAccessibleName(field.group + ", " + field.label);
  connect(box, &QComboBox::currentIndexChanged, this, [this, box, &field] {
    SensorDesign next = design_;
    field.set(next, box->currentText());
    if (next.resistance.index() != design_.resistance.index()) next.resistance = otherLaw_;
    if (const std::vector<DesignFault> faults = check(next); !faults.empty()) {
      emit refused(QString::fromStdString(faults.front().key + ": " + faults.front().sentence));
      display(design_);
      return;
    }
    emit edited(tr("Change %1").arg((field.group + " " + field.label).toLower()), next);
  });
  return box;
}

void LawBar::display(const SensorDesign& design) {
  if (design.resistance.index() != design_.resistance.index()) otherLaw_ = design_.resistance;
  design_ = design;
  for (const auto& [box, key] : {std::pair{law_, "resistance.law"}, std::pair{readout_, "resistance.readout"}}) {
    const QSignalBlocker quiet(box);
    box->setVisible(designField(key).has(design));
    box->setCurrentText(designField(key).text(design));
  }
}

} // namespace palp
