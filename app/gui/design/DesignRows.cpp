#include "app/gui/design/DesignRows.h"

#include "app/gui/widgets/Markup.h"
#include "app/gui/widgets/WrappedLabel.h"

#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QStyle>

#include <algorithm>

namespace palp {

namespace {

constexpr qsizetype kLongChoice = 16;

QComboBox* choiceOf(const DesignField& field) {
  auto* box = new QComboBox;
  box->setSizeAdjustPolicy(QComboBox::AdjustToContents);
  for (const DesignChoice& choice : field.choices) {
    box->addItem(choice.words);
    box->setItemData(box->count() - 1, choice.tip, Qt::ToolTipRole);
  }
  return box;
}

/// What a design has of a parameter, with its unit; where it has no such parameter, the law it has instead.
QString usedWords(const DesignField& field, const SensorDesign& inUse) {
  if (!field.has(inUse)) return designField(field.key.section('.', 0, 0) + ".law").text(inUse);
  return field.text(inUse) + (field.unit.isEmpty() ? QString() : " " + field.unit);
}

} // namespace

WrappedLabel* problemLabel() {
  auto* label = new WrappedLabel;
  label->setProperty("role", "problem");
  label->hide();
  return label;
}

void markWrong(QLineEdit& edit, bool wrong) {
  if (edit.property("wrong").toBool() == wrong) return;
  edit.setProperty("wrong", wrong);
  edit.style()->unpolish(&edit);
  edit.style()->polish(&edit);
}

QString DesignRows::Row::words() const {
  return edit != nullptr ? edit->text() : choice->currentText();
}

QWidget* DesignRows::Row::widget() const {
  if (edit != nullptr) return edit;
  return choice;
}

void DesignRows::add(const DesignField& field, QFormLayout& form, const std::function<void()>& edited) {
  Row row{.field = &field, .problem = problemLabel()};
  if (field.choices.empty()) {
    row.edit = new QLineEdit;
    QObject::connect(row.edit, &QLineEdit::textEdited, row.edit, edited);
  } else {
    row.choice = choiceOf(field);
    QObject::connect(row.choice, &QComboBox::currentIndexChanged, row.choice, edited); // quiet while one is displayed
  }
  QWidget* const widget = row.widget();
  widget->setObjectName(field.key);
  widget->setToolTip(QString("<qt>%1<br><i>%2</i></qt>").arg(asWritten(field.tip), field.key));
  widget->setAccessibleName(field.group + ", " + field.label);
  const QString label = field.label.left(1).toUpper() + field.label.mid(1);
  row.label = new QLabel(field.unit.isEmpty() ? label : label + " [" + field.unit + "]");
  row.label->setBuddy(widget);
  const auto isLong = [](const DesignChoice& choice) { return choice.words.size() > kLongChoice; };
  if (std::any_of(field.choices.begin(), field.choices.end(), isLong)) { // next to its label it would be cut
    form.addRow(row.label);
    form.addRow(widget);
  } else {
    form.addRow(row.label, widget);
  }
  row.problem->setObjectName(field.key + " problem");
  form.addRow(row.problem);
  rows_.push_back(row);
}

void DesignRows::display(const SensorDesign& design) {
  for (const Row& row : rows_) {
    row.problem->say({});
    row.widget()->setProperty("unapplied", false);
    if (row.edit != nullptr) markWrong(*row.edit, false);
    if (!row.field->has(design)) continue;
    if (row.choice != nullptr) {
      const QSignalBlocker quiet(row.choice);
      row.choice->setCurrentText(row.field->text(design));
      continue;
    }
    SensorDesign written = design;
    const bool same = row.field->set(written, row.words()).isEmpty() && written == design;
    if (!same) row.edit->setText(row.field->text(design));
    row.edit->setCursorPosition(same ? row.edit->cursorPosition() : 0);
  }
}

bool DesignRows::read(SensorDesign& design, const QString& keys) {
  bool good = true;
  for (Row& row : rows_) {
    row.wrong.clear();
    if (!row.field->key.startsWith(keys)) continue;
    row.wrong = row.field->set(design, row.words());
    good = good && row.wrong.isEmpty();
  }
  return good;
}

void DesignRows::say(const std::vector<DesignFault>& faults, const SensorDesign& inUse, bool applied) {
  for (Row& row : rows_) {
    QString sentence = row.wrong;
    for (const DesignFault& fault : faults)
      if (sentence.isEmpty() && QString::fromStdString(fault.key).startsWith(row.field->key))
        sentence = QString::fromStdString(fault.sentence);
    SensorDesign written = inUse;
    const bool same = row.field->set(written, row.words()).isEmpty() && written == inUse;
    // For numbers of a law that is not in use the law's own row reports it.
    const bool used = row.field->has(inUse) ? same : sentence.isEmpty();
    if (!applied && !used) {
      const QString words = usedWords(*row.field, inUse);
      sentence = sentence.isEmpty()
                     ? QObject::tr("Not applied while another field is invalid. The design still has %1.").arg(words)
                     : QObject::tr("%1. The design still has %2.").arg(sentence, words);
    }
    if (row.label->isHidden()) sentence.clear();
    row.problem->say(sentence);
    row.widget()->setProperty("unapplied", !applied);
    if (row.edit != nullptr) markWrong(*row.edit, !sentence.isEmpty());
  }
}

void DesignRows::showThoseOf(const SensorDesign& design) {
  for (const Row& row : rows_) {
    const bool has = row.field->has(design);
    row.label->setVisible(has);
    row.widget()->setVisible(has);
    if (!has) row.problem->say({});
  }
}

} // namespace palp
