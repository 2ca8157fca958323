#include "app/gui/network/AdvancedOptions.h"

#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "model/base/NumberText.h"
#include "model/base/Text.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>

namespace palp {

namespace {

/// As the option takes it: an empty text unsets it.
std::string typedText(const QString& typed) {
  const auto value = typedNumber(typed);
  return value ? text(*value) : typed.trimmed().toStdString();
}

/// What the option allows, or an empty field. Anything else goes back to what was shown, with a sentence.
class OptionValidator : public QValidator {
public:
  OptionValidator(const TrainOption& option, const QString& shown, QLineEdit& edit)
      : QValidator(&edit), option_(option), shown_(shown), edit_(edit) {}
  State validate(QString& input, int&) const override {
    TrainOptions tried;
    return option_.set(tried, typedText(input)) ? Acceptable : Intermediate;
  }
  void fixup(QString& input) const override {
    showNotApplied(
        edit_, QObject::tr("Not applied: got \"%1\", expected %2").arg(input, QString::fromStdString(option_.allowed)));
    input = shown_;
  }

private:
  const TrainOption& option_;
  const QString& shown_;
  QLineEdit& edit_;
};

/// "train_seed" -> "trainSeed".
QString objectNameOf(const std::string& key) {
  QString name;
  for (const QString& word : QString::fromStdString(key).split('_'))
    name += name.isEmpty() ? word : word.left(1).toUpper() + word.mid(1);
  return name;
}

QString capitalised(const std::string& words) {
  const QString all = QString::fromStdString(words);
  return all.left(1).toUpper() + all.mid(1);
}

void showValue(QWidget& widget, const std::string& value) {
  if (auto* box = qobject_cast<QComboBox*>(&widget))
    box->setCurrentIndex(value.empty() ? 0 : box->findText(QString::fromStdString(value)));
  else if (auto* edit = qobject_cast<QLineEdit*>(&widget))
    edit->setText(QString::fromStdString(value));
  else if (auto* whole = qobject_cast<QSpinBox*>(&widget))
    whole->setValue(static_cast<int>(numberIn(value).value()));
  else if (auto* number = qobject_cast<QDoubleSpinBox*>(&widget))
    showExactly(*number, numberIn(value).value());
}

std::string shownIn(const QWidget& widget, const QString& lastShown) {
  if (const auto* box = qobject_cast<const QComboBox*>(&widget))
    return box->currentIndex() == 0 ? std::string() : box->currentText().toStdString();
  if (const auto* edit = qobject_cast<const QLineEdit*>(&widget))
    return typedText(edit->hasAcceptableInput() ? edit->text() : lastShown);
  if (const auto* whole = qobject_cast<const QSpinBox*>(&widget)) return std::to_string(whole->value());
  return text(qobject_cast<const QDoubleSpinBox*>(&widget)->value());
}

} // namespace

AdvancedOptions::AdvancedOptions(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  more_ = new QToolButton;
  more_->setObjectName("moreOptions");
  more_->setText(tr("More options"));
  more_->setToolTip(tr("Options that follow from the mode unless they are set here. Disabled fields have no effect on "
                       "the selected decoder."));
  more_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  more_->setAutoRaise(true);
  more_->setCheckable(true);
  column->addWidget(more_);
  options_ = new QWidget;
  auto* form = new QFormLayout(options_);
  form->setContentsMargins(0, 0, 0, 0);
  allCenters_ = checkBox(tr("A centre on every sample"), "allCenters",
                         tr("Uses all samples as centres, regardless of their number"));
  form->addRow(QString(), allCenters_);
  for (const TrainOption& option : trainOptionTable())
    if (option.inForm) addField(*form, option);
  column->addWidget(options_);
  fold(false);
  connect(more_, &QToolButton::toggled, this, &AdvancedOptions::fold);
  connect(allCenters_, &QCheckBox::toggled, this, [this] { report(tr("Change the centres")); });
}

void AdvancedOptions::addField(QFormLayout& form, const TrainOption& option) {
  Field& field = fields_.emplace_back(Field{&option, nullptr, {}});
  field.widget = fieldWidget(field);
  field.widget->setObjectName(objectNameOf(option.key));
  field.widget->setToolTip(capitalised(option.help));
  form.addRow(capitalised(option.label), field.widget);
}

QWidget* AdvancedOptions::fieldWidget(Field& field) {
  const TrainOption& option = *field.option;
  const auto changed = [this, what = tr("Change the %1").arg(QString::fromStdString(option.label))] { report(what); };
  if (option.form == TrainOption::Form::Choice) {
    auto* box = new QComboBox;
    box->addItem(tr("From mode"));
    for (const std::string& value : option.choices) box->addItem(QString::fromStdString(value));
    connect(box, &QComboBox::currentIndexChanged, this, changed);
    return box;
  }
  if (option.initial.empty()) {
    auto* edit = new QLineEdit;
    edit->setPlaceholderText(tr("From mode"));
    edit->setValidator(new OptionValidator(option, field.shown, *edit));
    connect(edit, &QLineEdit::editingFinished, this, changed);
    return edit;
  }
  if (option.form == TrainOption::Form::WholeNumber) {
    auto* box = new WholeBox;
    box->setRange(static_cast<int>(option.low), static_cast<int>(option.high));
    box->setKeyboardTracking(false);
    connect(box, &QSpinBox::valueChanged, this, changed);
    return box;
  }
  auto* box = new NumberBox;
  box->setDecimals(6);
  box->setRange(option.low, option.high);
  box->setSingleStep(0.001);
  box->setKeyboardTracking(false);
  connect(box, &QDoubleSpinBox::valueChanged, this, changed);
  return box;
}

void AdvancedOptions::report(const QString& what) {
  if (!displaying_) emit edited(what);
}

void AdvancedOptions::fold(bool open) {
  options_->setVisible(open);
  more_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
}

/// An unset field shows what the mode makes of its option, where that is known.
void AdvancedOptions::showMode(const NetworkSettings& network) {
  TrainOptions unset;
  unset.input = network.input;
  unset.mode = network.mode;
  unset.noise = network.noise;
  const RbfOptions mode = rbfOptions(unset, 0);
  for (const Field& field : fields_) {
    const bool known = network.decoder == DecoderKind::Rbf && field.option->ofMode;
    const QString words =
        known ? tr("From mode: %1").arg(QString::fromStdString(field.option->ofMode(mode))) : tr("From mode");
    if (auto* box = qobject_cast<QComboBox*>(field.widget)) box->setItemText(0, words);
    if (auto* edit = qobject_cast<QLineEdit*>(field.widget)) edit->setPlaceholderText(words);
  }
}

void AdvancedOptions::display(const NetworkSettings& network) {
  displaying_ = true;
  showMode(network);
  for (Field& field : fields_) {
    const std::string value = field.option->text(network);
    field.shown = QString::fromStdString(value);
    showValue(*field.widget, value);
    field.widget->setEnabled(field.option->applies(network.decoder));
  }
  allCenters_->setChecked(network.allCenters);
  allCenters_->setEnabled(traits(network.decoder).hasRbf);
  displaying_ = false;
  if (network.trainOptionsSet()) more_->setChecked(true);
}

void AdvancedOptions::read(NetworkSettings& network) const {
  for (const Field& field : fields_) field.option->set(network, shownIn(*field.widget, field.shown));
  network.allCenters = allCenters_->isChecked();
}

} // namespace palp
