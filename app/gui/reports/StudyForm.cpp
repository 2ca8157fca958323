#include "app/gui/reports/StudyForm.h"

#include "app/gui/design/DesignRows.h"
#include "app/gui/reports/ReportFolders.h"
#include "app/gui/reports/ReportKinds.h"
#include "app/gui/widgets/FileDialogs.h"
#include "app/gui/widgets/KeepRoom.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"
#include "app/gui/widgets/UnclearComma.h"
#include "app/gui/widgets/WrappedLabel.h"
#include "io/AtomicFile.h"
#include "io/DesignFile.h"
#include "model/base/Error.h"
#include "model/base/Text.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace palp {

namespace {

constexpr int kMostAxes = 4;  // that are visible together
constexpr int kHypercube = 1; // in the list of plans
constexpr int kOfTheFile = 1; // in the list of designs

/// A row of widgets without margins.
QWidget* rowOf(const std::vector<QWidget*>& widgets, bool stretched = true) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  for (QWidget* widget : widgets) layout->addWidget(widget);
  if (stretched) layout->addStretch(1);
  return row;
}

QSpinBox* spin(const char* name, int low, int high, int value, const QString& words, const QString& tip) {
  auto* box = wholeBox(name, {.low = low, .high = high, .whileTyping = true}, tip, words);
  box->setValue(value);
  return box;
}

struct QuantityWords {
  const char* name;
  const char* tip;
};
/// In the order of kStudyQuantities.
constexpr std::array<QuantityWords, 4> kQuantityWords{{
    {QT_TRANSLATE_NOOP("palp::StudyForm", "Noise floor"),
     QT_TRANSLATE_NOOP("palp::StudyForm", "Cramer-Rao bound of the force, all row-wires, by area, in % of the range")},
    {QT_TRANSLATE_NOOP("palp::StudyForm", "Errors of decoders"),
     QT_TRANSLATE_NOOP("palp::StudyForm", "Errors of decoders on fresh samples with noise, in % of the range")},
    {QT_TRANSLATE_NOOP("palp::StudyForm", "Largest displacement"),
     QT_TRANSLATE_NOOP("palp::StudyForm", "Largest displacement under the largest load on area 0")},
    {QT_TRANSLATE_NOOP("palp::StudyForm", "Error of the mesh"),
     QT_TRANSLATE_NOOP("palp::StudyForm", "Estimated discretisation error of that solve")},
}};

} // namespace

StudyForm::StudyForm(Workbench& workbench, QWidget* parent) : QWidget(parent), workbench_(workbench) {
  build();
  listKeys();
  addAxis("block_mm.2", proposal("block_mm.2"));
  connect(&workbench, &Workbench::projectChanged, this, [this] {
    if (isVisible()) check();
  });
  check();
}

void StudyForm::build() {
  setObjectName("studyForm");
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  addTo(*column, {buildSettings(), buildAxes(), buildQuantities()});
  problem_ = problemLabel();
  problem_->setObjectName("studyProblem");
  keepRoom(*problem_);
  column->addWidget(problem_);
  column->addWidget(buildResult());
}

QWidget* StudyForm::buildSettings() {
  base_ = choiceBox("studyDesign", {},
                    tr("Design whose parameters vary, and its mesh: that of the project, or that of the study file"),
                    tr("Base design"));
  base_->addItem(tr("The project's design"));
  plan_ = choiceBox("studyPlan", {tr("Every combination"), tr("Latin hypercube of")},
                    tr("Every combination of all values, or a Latin hypercube: a given number of designs, one in each "
                       "of as many strata of every parameter"),
                    tr("Designs"));
  points_ = spin("studyPoints", 2, 1'000'000, 20, tr("Designs of the hypercube"), tr("Designs of the Latin hypercube"));
  seed_ = spin("studySeed", 0, std::numeric_limits<int>::max(), 1, tr("Seed"), tr("Seed of all random numbers"));
  auto* openFile = pushButton(tr("Open..."), "openStudy", tr("Opens a study file"));
  auto* saveFile =
      pushButton(tr("Save..."), "saveStudy", tr("Saves the study as a file for palp study and palp cluster"));
  connect(openFile, &QPushButton::clicked, this, &StudyForm::open);
  connect(saveFile, &QPushButton::clicked, this, &StudyForm::save);
  connect(base_, &QComboBox::currentIndexChanged, this, &StudyForm::check);
  connect(plan_, &QComboBox::currentIndexChanged, this, &StudyForm::check);
  for (QSpinBox* box : {points_, seed_}) connect(box, &QSpinBox::valueChanged, this, &StudyForm::check);
  return rowOf({new QLabel(tr("Vary")), base_, plan_, points_, new QLabel(tr("Seed")), seed_, openFile, saveFile});
}

QWidget* StudyForm::buildAxes() {
  auto* inside = new QWidget;
  axesColumn_ = new QVBoxLayout(inside);
  axesColumn_->setContentsMargins(0, 0, 0, 0);
  axesColumn_->setSpacing(2);
  auto* more = pushButton(tr("Add parameter"), "addStudyKey", tr("Adds a parameter of the design that varies"));
  connect(more, &QPushButton::clicked, this, [this] {
    for (const std::string& key : studyKeys(design())) {
      const QString name = QString::fromStdString(key);
      const bool used =
          std::any_of(axes_.begin(), axes_.end(), [&](const Axis& a) { return a.key->currentText() == name; });
      if (used || key == "palp_design" || studyNumber(design(), key) == 0) continue;
      addAxis(name, proposal(name));
      axes_.back().key->setFocus();
      break;
    }
    check();
  });
  axesColumn_->addWidget(rowOf({more}));
  axesColumn_->addStretch(1);
  axesArea_ = new QScrollArea;
  axesArea_->setWidget(inside);
  axesArea_->setWidgetResizable(true);
  axesArea_->setFrameShape(QFrame::NoFrame);
  return axesArea_;
}

QWidget* StudyForm::buildQuantities() {
  std::vector<QWidget*> row{new QLabel(tr("Compute"))};
  for (const auto& [quantity, name] : kStudyQuantities.all()) {
    const QuantityWords& words = kQuantityWords.at(quantities_.size());
    auto* box = checkBox(tr(words.name), QString("study-") + name, tr(words.tip));
    box->setChecked(quantity == StudyQuantity::Bound || quantity == StudyQuantity::Displacement);
    connect(box, &QCheckBox::toggled, this, &StudyForm::check);
    quantities_.push_back(box);
    row.push_back(box);
  }
  decoders_ = new QLineEdit("rbf");
  decoders_->setObjectName("studyDecoders");
  decoders_->setAccessibleName(tr("Decoders"));
  decoders_->setToolTip(
      tr("Names of the decoders, separated by commas: %1").arg(QString::fromStdString(kDecoderKinds.allowed())));
  perArea_ = spin("studyPerArea", 5, 100'000, 20, tr("Samples per area"),
                  tr("Number of training samples on each area, and as many again for testing"));
  noise_ = new QLineEdit("1e-4");
  noise_->setObjectName("studyNoise");
  noise_->setAccessibleName(tr("Noise"));
  noise_->setToolTip(tr("Relative noise of each resistance"));
  noise_->setMaximumWidth(80);
  for (QLineEdit* edit : {decoders_, noise_}) connect(edit, &QLineEdit::textChanged, this, &StudyForm::check);
  connect(perArea_, &QSpinBox::valueChanged, this, &StudyForm::check);
  for (QWidget* more : std::initializer_list<QWidget*>{new QLabel(tr("Noise")), noise_, new QLabel(tr("Decoders")),
                                                       decoders_, new QLabel(tr("Samples per area")), perArea_})
    row.push_back(more);
  return rowOf(row);
}

QWidget* StudyForm::buildResult() {
  chosen_ = spin("studyChosen", 0, 0, 0, tr("Number of the design"),
                 tr("Number of the design in the first column of the table"));
  take_ = pushButton(tr("Use this design"), "takeStudyDesign",
                     tr("Makes this design of the study the project's design; this can be undone"));
  connect(take_, &QPushButton::clicked, this, &StudyForm::takeOver);
  result_ = rowOf({new QLabel(tr("Design number")), chosen_, take_});
  return result_;
}

const SensorDesign& StudyForm::design() const {
  return base_->currentIndex() == kOfTheFile ? *openedDesign_ : workbench_.project().design;
}

QString StudyForm::proposal(const QString& key) const {
  const std::vector<std::string> keys = studyKeys(design());
  if (std::find(keys.begin(), keys.end(), key.toStdString()) == keys.end())
    return {}; // typed: check() reports what it is
  const double value = studyNumber(design(), key.toStdString());
  if (key.startsWith("areas.")) return QString("%1, %2").arg(value).arg(value + 1); // whole numbers
  const auto rounded = [](double number) { return QString::number(number, 'g', 3); };
  return rounded(0.9 * value) + ".." + rounded(1.1 * value) + " x 3";
}

void StudyForm::listKeys() {
  listed_ = design();
  QStringList keys;
  for (const std::string& key : studyKeys(listed_))
    if (key != "palp_design") keys << QString::fromStdString(key);
  for (const Axis& axis : axes_) {
    const QSignalBlocker quiet(axis.key);
    const QString now = axis.key->currentText();
    axis.key->clear();
    axis.key->addItems(keys);
    axis.key->setCurrentText(now);
  }
}

void StudyForm::addAxis(const QString& key, const QString& values) {
  Axis axis;
  axis.key = new QComboBox;
  axis.key->setAccessibleName(tr("Parameter"));
  axis.key->setToolTip(tr("Key in the design file; numeric keys are listed, others (such as "
                          "lower_layer.follows_rubber, or a complete list of wires) can be typed"));
  axis.key->setEditable(true);
  axis.key->setMinimumWidth(260);
  axis.values = new QLineEdit(values);
  axis.values->setAccessibleName(tr("Values"));
  axis.values->setToolTip(tr("A range, 3..6 x 4, or with equal factors, 0.1..10 x 5 log; or a list, 3, 4.5, 6. A Latin "
                             "hypercube needs no count."));
  auto* away = new QToolButton;
  away->setText("x");
  away->setAccessibleName(tr("Remove"));
  away->setToolTip(tr("Removes this parameter from the study"));
  axis.row = rowOf({axis.key, axis.values, away}, false);
  static_cast<QHBoxLayout*>(axis.row->layout())->setStretch(1, 1);
  connect(axis.key, &QComboBox::currentTextChanged, this, &StudyForm::check);
  connect(axis.key, &QComboBox::activated, this, [this, row = axis.row] {
    for (const Axis& each : axes_)
      if (each.row == row) each.values->setText(proposal(each.key->currentText()));
  });
  connect(axis.values, &QLineEdit::textChanged, this, &StudyForm::check);
  connect(away, &QToolButton::clicked, this, [this, row = axis.row] { removeAxis(row); });
  axesColumn_->insertWidget(static_cast<int>(axes_.size()), axis.row);
  axes_.push_back(axis);
  numberAxes();
  const bool before = std::exchange(showing_, true);
  listKeys();
  axis.key->setCurrentText(key);
  showing_ = before;
}

void StudyForm::removeAxis(const QWidget* row) {
  const auto found = std::find_if(axes_.begin(), axes_.end(), [&](const Axis& axis) { return axis.row == row; });
  if (found == axes_.end()) return;
  found->row->deleteLater(); // its button is at work
  found->row->hide();
  axesColumn_->removeWidget(found->row);
  found->key->setObjectName({});
  found->values->setObjectName({});
  axes_.erase(found);
  numberAxes();
  check();
}

void StudyForm::numberAxes() {
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    axes_[i].key->setObjectName(QString("studyKey%1").arg(i));
    axes_[i].values->setObjectName(QString("studyValues%1").arg(i));
  }
  const int row_px = axes_.empty() ? 0 : axes_.front().row->sizeHint().height() + axesColumn_->spacing();
  axesArea_->setFixedHeight((std::min(static_cast<int>(axes_.size()), kMostAxes) + 1) * row_px);
}

StudyAxis StudyForm::typedAxis(const Axis& axis) {
  const QString key = axis.key->currentText().trimmed(), values = axis.values->text();
  const QString unclear = values.contains('[') ? QString() : unclearComma(values); // JSON has no decimal commas
  if (!unclear.isEmpty()) throw Error((key + ": " + unclear).toStdString());
  return studyAxis(key.toStdString(), values.toStdString());
}

StudyPlan StudyForm::plan() const {
  const bool ofFile = base_->currentIndex() == kOfTheFile;
  StudyPlan plan;
  plan.design = ofFile ? opened_->design : toJson(workbench_.project().design);
  for (const Axis& axis : axes_) plan.axes.push_back(typedAxis(axis));
  plan.hypercube = plan_->currentIndex() == kHypercube ? points_->value() : 0;
  plan.seed = static_cast<std::uint64_t>(seed_->value());
  for (std::size_t i = 0; i < quantities_.size(); ++i)
    if (quantities_[i]->isChecked()) plan.quantities.push_back(kStudyQuantities.all()[i].first);
  if (plan.computes(StudyQuantity::Decoders))
    for (const QString& name : decoders_->text().split(','))
      plan.decoders.push_back(kDecoderKinds.value(name.trimmed().toStdString()));
  const auto noise = typedNumber(noise_->text());
  if (!noise) throw Error("noise: '" + noise_->text().toStdString() + "'; expected a number from 1e-9 to 0.5");
  plan.noise = *noise;
  plan.perArea = perArea_->value();
  plan.meshSize_mm = ofFile ? opened_->meshSize_mm : workbench_.project().mesh.meshSize_mm;
  plan.mapped = ofFile ? opened_->mapped : workbench_.project().mesh.mapped;
  return parseStudy(toJson(plan), "study");
}

void StudyForm::show(const StudyPlan& plan) {
  showing_ = true;
  opened_ = plan;
  openedDesign_ = parseDesign(plan.design, "study");
  if (base_->count() == kOfTheFile) base_->addItem(tr("The study file's design"));
  base_->setCurrentIndex(kOfTheFile);
  for (const Axis& axis : axes_) delete axis.row;
  axes_.clear();
  for (const StudyAxis& axis : plan.axes)
    addAxis(QString::fromStdString(axis.key), QString::fromStdString(studyWords(axis)));
  plan_->setCurrentIndex(plan.hypercube > 0 ? kHypercube : 0);
  if (plan.hypercube > 0) points_->setValue(plan.hypercube);
  seed_->setValue(static_cast<int>(plan.seed));
  for (std::size_t i = 0; i < quantities_.size(); ++i)
    quantities_[i]->setChecked(plan.computes(kStudyQuantities.all()[i].first));
  QStringList names;
  for (const DecoderKind kind : plan.decoders) names << QString::fromStdString(name(kind));
  if (!names.isEmpty()) decoders_->setText(names.join(", "));
  noise_->setText(QString::fromStdString(text(plan.noise)));
  perArea_->setValue(plan.perArea);
  showing_ = false;
  check();
}

QString StudyForm::runFolder(const QString& base) const {
  const std::string content = toJson(plan());
  const QString before = QDir(unfinished_).filePath(kStudyFile);
  if (!unfinished_.isEmpty() && QFileInfo::exists(before) && readFile(before.toStdString()) == content)
    return unfinished_;
  QString folder = newReportFolder(base, kStudyKind, QDateTime::currentDateTime());
  writeFile(QDir(folder).filePath(kStudyFile).toStdString(), content, false);
  return folder;
}

void StudyForm::check() {
  if (showing_) return;
  if (listed_ != design()) {
    showing_ = true;
    listKeys();
    showing_ = false;
  }
  points_->setVisible(plan_->currentIndex() == kHypercube);
  const bool decoders = quantities_[1]->isChecked();
  for (QWidget* widget : std::initializer_list<QWidget*>{decoders_, perArea_}) widget->setEnabled(decoders);
  QString wrong;
  std::size_t designs = 0;
  try {
    designs = plan().designs();
  } catch (const Error& error) {
    wrong = QString::fromStdString(error.what());
  }
  problem_->say(wrong);
  result_->setEnabled(wrong.isEmpty());
  chosen_->setMaximum(std::max(0, static_cast<int>(designs) - 1));
  emit changed();
}

void StudyForm::open() {
  const QString file = askFileToOpen(this, tr("Open study"), tr("Studies (*.json)"));
  if (file.isEmpty()) return;
  try {
    show(loadStudy(file.toStdString()));
  } catch (const Error& error) {
    problem_->say(QString::fromStdString(error.what()));
  }
}

void StudyForm::save() {
  try {
    const std::string content = toJson(plan());
    const QString file = askFileToSave(this, tr("Save study"), "study.json", tr("Studies (*.json)"));
    if (!file.isEmpty()) writeFile(file.toStdString(), content, true); // confirmed in the dialog
  } catch (const Error& error) {
    problem_->say(QString::fromStdString(error.what()));
  }
}

void StudyForm::takeOver() {
  try {
    const StudyPlan study = plan();
    const int number = chosen_->value();
    Project next = workbench_.project();
    next.design = study.at(static_cast<std::size_t>(number));
    show(study); // on the design it was of, not on the one that is taken over
    workbench_.edit(tr("Use design %1 of the study").arg(number), next);
    workbench_.closeEntry();
  } catch (const Error& error) {
    problem_->say(QString::fromStdString(error.what()));
  }
}

} // namespace palp
