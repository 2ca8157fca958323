#include "app/gui/network/AdvancedOptions.h"

#include "app/gui/network/words/FitWords.h"
#include "app/gui/widgets/SpinBoxes.h"
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

template <class Names> std::vector<std::string> namesOf(const Names& names) {
  std::vector<std::string> all;
  for (const auto& [value, text] : names.all()) all.emplace_back(text);
  return all;
}

/// The first entry leaves it to the mode.
template <class Names> auto chosen(const QComboBox& box, const Names& names) {
  return names.find(box.currentIndex() == 0 ? std::string() : box.currentText().toStdString());
}

template <class Value, class Names> void choose(QComboBox& box, const std::optional<Value>& value, const Names& names) {
  if (value)
    box.setCurrentText(QString::fromStdString(names.name(*value)));
  else
    box.setCurrentIndex(0);
}

/// A number from 0, or an empty field. Anything else goes back to what was shown, with a sentence.
class NumberOrNothing : public QValidator {
public:
  NumberOrNothing(const QString& shown, QLineEdit& edit) : QValidator(&edit), shown_(shown), edit_(edit) {}
  State validate(QString& input, int&) const override {
    const auto value = typedNumber(input);
    return input.isEmpty() || (value && *value >= 0) ? Acceptable : Intermediate;
  }
  void fixup(QString& input) const override {
    sayNotApplied(edit_, QObject::tr("Not applied: \"%1\" is not a number from 0").arg(input));
    input = shown_;
  }

private:
  const QString& shown_;
  QLineEdit& edit_;
};

} // namespace

AdvancedOptions::AdvancedOptions(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  more_ = new QToolButton;
  more_->setObjectName("moreOptions");
  more_->setText(tr("More options"));
  more_->setToolTip(tr("Solver, ridge, scaler, tail, convention, centres and seed: what is not set follows from the "
                       "mode; what is grey does not act on the decoder that is chosen"));
  more_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
  more_->setAutoRaise(true);
  more_->setCheckable(true);
  column->addWidget(more_);
  options_ = new QWidget;
  auto* form = new QFormLayout(options_);
  form->setContentsMargins(0, 0, 0, 0);
  solver_ = choice(*form, tr("Solver"), "solver", tr("How the least-squares system of the weights is solved"),
                   namesOf(kLeastSquaresMethods));
  ridge_ = new QLineEdit;
  ridge_->setObjectName("ridge");
  ridge_->setPlaceholderText(tr("as the mode says"));
  ridge_->setToolTip(tr("Ridge of the system, 0 or above; empty: 0, or by leave-one-out where there is noise"));
  ridge_->setValidator(new NumberOrNothing(ridgeShown_, *ridge_));
  form->addRow(tr("Ridge"), ridge_);
  scaler_ = choice(*form, tr("Scaler"), "scaler", tr("How the inputs are scaled before the spread acts on them"),
                   namesOf(kScalings));
  tail_ = choice(*form, tr("Tail"), "tail", tr("What is added to the Gaussians: nothing, a bias, a linear part"),
                 namesOf(kTails));
  convention_ = choice(*form, tr("Convention"), "convention", tr("What a spread means"), namesOf(kSpreadConventions));
  centersBy_ = choice(*form, tr("Centres by"), "centersBy", tr("How centres are chosen among the samples"),
                      namesOf(kCenterChoices));
  allCenters_ = new QCheckBox(tr("a centre on every sample"));
  allCenters_->setObjectName("allCenters");
  allCenters_->setToolTip(tr("However many samples there are"));
  form->addRow(QString(), allCenters_);
  seed_ = new WholeBox;
  seed_->setObjectName("trainSeed");
  seed_->setRange(0, 1000000000);
  seed_->setKeyboardTracking(false);
  seed_->setToolTip(tr("Seed of centres, noise and starts. Without noise it moves the centres alone; with a centre on "
                       "every sample, the noise alone"));
  form->addRow(tr("Seed of training"), seed_);
  forgetting_ = new NumberBox;
  forgetting_->setObjectName("forgetting");
  forgetting_->setDecimals(6);
  forgetting_->setRange(1e-6, 1);
  forgetting_->setSingleStep(0.001);
  forgetting_->setKeyboardTracking(false);
  forgetting_->setToolTip(tr("Of the solver rls: what an earlier sample counts beside the next one"));
  form->addRow(tr("Forgetting"), forgetting_);
  column->addWidget(options_);
  fold(false);
  connect(more_, &QToolButton::toggled, this, &AdvancedOptions::fold);
  const auto tell = [this](const QString& what) {
    if (!displaying_) emit edited(what);
  };
  connect(ridge_, &QLineEdit::editingFinished, this, [tell] { tell(tr("Change the ridge")); });
  connect(allCenters_, &QCheckBox::toggled, this, [tell] { tell(tr("Change the centres")); });
  connect(seed_, &QSpinBox::valueChanged, this, [tell] { tell(tr("Change the seed of the training")); });
  connect(forgetting_, &QDoubleSpinBox::valueChanged, this, [tell] { tell(tr("Change the forgetting")); });
  for (const auto& [box, what] :
       {std::pair{solver_, tr("Change the solver")}, std::pair{scaler_, tr("Change the scaler")},
        std::pair{tail_, tr("Change the tail")}, std::pair{convention_, tr("Change the convention")},
        std::pair{centersBy_, tr("Change how centres are chosen")}})
    connect(box, &QComboBox::currentIndexChanged, this, [tell, what = what] { tell(what); });
}

QComboBox* AdvancedOptions::choice(QFormLayout& form, const QString& label, const char* name, const QString& tip,
                                   const std::vector<std::string>& values) {
  auto* box = new QComboBox;
  box->setObjectName(name);
  box->setToolTip(tip);
  box->addItem(tr("as the mode says"));
  for (const std::string& value : values) box->addItem(QString::fromStdString(value));
  form.addRow(label, box);
  return box;
}

void AdvancedOptions::fold(bool open) {
  options_->setVisible(open);
  more_->setArrowType(open ? Qt::DownArrow : Qt::RightArrow);
}

/// What the mode says stands beside the words, where the decoder uses it.
void AdvancedOptions::showMode(const NetworkSettings& network) {
  NetworkSettings unset;
  unset.input = network.input;
  unset.mode = network.mode;
  unset.noise = network.noise;
  const RbfOptions mode = rbfOptions(unset.trainOptions(), 0);
  const bool rbf = network.decoder == DecoderKind::Rbf;
  const auto say = [rbf](QComboBox& box, const std::string& value) {
    box.setItemText(0, rbf ? tr("mode: %1").arg(QString::fromStdString(value)) : tr("as the mode says"));
  };
  say(*solver_, name(mode.method));
  say(*scaler_, name(mode.scaling));
  say(*tail_, kTails.name(mode.tail));
  say(*convention_, name(mode.convention));
  ridge_->setPlaceholderText(!rbf                ? tr("as the mode says")
                             : network.noise > 0 ? tr("mode: leave-one-out")
                                                 : tr("mode: 0"));
}

/// DecoderTraining.cpp and TwoStep.cpp: which options each decoder takes.
void AdvancedOptions::enableFor(DecoderKind decoder) {
  for (QWidget* only :
       std::initializer_list<QWidget*>{solver_, tail_, convention_, centersBy_, allCenters_, forgetting_})
    only->setEnabled(hasSpread(decoder));
  ridge_->setEnabled(hasRidge(decoder));
  scaler_->setEnabled(hasSpread(decoder) || decoder == DecoderKind::GaussianProcess);
  seed_->setEnabled(decoder != DecoderKind::MaximumLikelihood);
}

void AdvancedOptions::display(const NetworkSettings& network) {
  displaying_ = true;
  showMode(network);
  enableFor(network.decoder);
  choose(*solver_, network.solver, kLeastSquaresMethods);
  choose(*scaler_, network.scaling, kScalings);
  choose(*tail_, network.tail, kTails);
  choose(*convention_, network.convention, kSpreadConventions);
  choose(*centersBy_, network.centerChoice, kCenterChoices);
  allCenters_->setChecked(network.allCenters);
  ridgeShown_ = network.ridge ? QString::fromStdString(text(*network.ridge)) : QString();
  ridge_->setText(ridgeShown_);
  seed_->setValue(static_cast<int>(network.seed));
  showExactly(*forgetting_, network.forgetting);
  displaying_ = false;
  if (network.trainOptionsSet()) more_->setChecked(true);
}

void AdvancedOptions::read(NetworkSettings& network) const {
  network.solver = chosen(*solver_, kLeastSquaresMethods);
  network.scaling = chosen(*scaler_, kScalings);
  network.tail = chosen(*tail_, kTails);
  network.convention = chosen(*convention_, kSpreadConventions);
  network.centerChoice = chosen(*centersBy_, kCenterChoices);
  network.allCenters = allCenters_->isChecked();
  network.ridge = typedNumber(ridge_->hasAcceptableInput() ? ridge_->text() : ridgeShown_);
  network.seed = static_cast<std::uint64_t>(seed_->value());
  network.forgetting = forgetting_->value();
}

} // namespace palp
