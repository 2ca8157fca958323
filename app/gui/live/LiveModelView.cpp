#include "app/gui/live/LiveModelView.h"

#include "app/gui/jobs/FieldTouch.h"
#include "app/gui/views/BlockView.h"
#include "app/gui/widgets/MakeWidgets.h"
#include "model/base/Error.h"
#include "solver/ConductionField.h"
#include "solver/MeshCost.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include <cmath>

namespace palp {

struct LiveModelView::Result {
  Touch touch;
  std::shared_ptr<const NodalFields> fields;
  std::optional<TouchResistances> resistances;  ///< by the design's law
  std::shared_ptr<const ConductionField> field; ///< for the next load on the same block; null by Eq. (1)
  Eigen::MatrixXd measured;                     ///< R / R at rest - 1
};

namespace {

QString loadWords(const LoadCase& load) {
  QStringList words;
  for (const AreaLoad& area : load.areas)
    words << QObject::tr("area %1: (%2, %3, %4) N")
                 .arg(area.area)
                 .arg(area.force_N.x(), 0, 'f', 3)
                 .arg(area.force_N.y(), 0, 'f', 3)
                 .arg(area.force_N.z(), 0, 'f', 3);
  for (const PatchLoad& disc : load.patches)
    words << QObject::tr("a disc of %1 mm at (%2, %3) mm: (%4, %5, %6) N")
                 .arg(disc.radius_mm, 0, 'g', 3)
                 .arg(disc.centre_mm.x(), 0, 'f', 2)
                 .arg(disc.centre_mm.y(), 0, 'f', 2)
                 .arg(disc.force_N.x(), 0, 'f', 3)
                 .arg(disc.force_N.y(), 0, 'f', 3)
                 .arg(disc.force_N.z(), 0, 'f', 3);
  for (const Indenter& indenter : load.indenters)
    words << QObject::tr("%1 of %2 mm at (%3, %4) mm: (%5, %6, %7) N")
                 .arg(QString::fromStdString(shapeName(indenter.shape)))
                 .arg(indenter.radius_mm, 0, 'g', 3)
                 .arg(indenter.place_mm.x(), 0, 'f', 2)
                 .arg(indenter.place_mm.y(), 0, 'f', 2)
                 .arg(indenter.press()->force_N.x(), 0, 'f', 3)
                 .arg(indenter.press()->force_N.y(), 0, 'f', 3)
                 .arg(indenter.press()->force_N.z(), 0, 'f', 3);
  return words.join(", ");
}

/// How far the model's dR/R is from the board's, as share of the board's; none where the two do not compare.
std::optional<double> mismatch(const std::optional<TouchResistances>& resistances, const Eigen::MatrixXd& measured) {
  if (!resistances) return {};
  const auto& [rest, now] = *resistances;
  if (measured.rows() != rest.rows() || measured.cols() != rest.cols()) return {};
  const Eigen::ArrayXXd model = now.array() / rest.array() - 1;
  const auto good = measured.array().isFinite().eval();
  const double difference = good.select((model - measured.array()).square(), 0.0).sum();
  const double size = good.select(measured.array().square(), 0.0).sum();
  return size > 0 ? std::optional(std::sqrt(difference / size)) : std::nullopt;
}

} // namespace

LiveModelView::LiveModelView(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(0, 0, 0, 0);
  auto* row = new QHBoxLayout;
  row->setContentsMargins(8, 8, 8, 2);
  auto* solve = pushButton(tr("Solve for this force"), "solveTwin",
                           tr("Meshes and solves the block under the latest decoded force (W)"));
  use_ = pushButton(tr("Use in Deformation"), "takeLoad",
                    tr("Makes this force the load of the Deformation scene; this can be undone"));
  use_->setEnabled(false);
  words_ = textLabel("twinWords");
  addTo(*row, {solve, use_, Part::stretch()});
  words_->setContentsMargins(8, 0, 8, 0);
  column->addLayout(row);
  column->addWidget(words_);
  view_ = new BlockView;
  view_->setObjectName("twin");
  column->addWidget(view_, 1);
  options_.meshEdges = false;
  connect(solve, &QPushButton::clicked, this, &LiveModelView::solveRequested);
  connect(use_, &QPushButton::clicked, this, [this] { emit loadRequested(result_->touch.load()); });
  connect(&runner_, &JobRunner::failed, words_, &QLabel::setText);
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (cancelled) displayWords();
  });
  displayWords();
  connect(&runner_, &JobRunner::progressed, this, [this](double, const QString& what) { words_->setText(what); });
}

LiveModelView::~LiveModelView() = default;

const Touch* LiveModelView::touch() const {
  return result_ ? &result_->touch : nullptr;
}

void LiveModelView::solve(const SensorDesign& design, const LoadCase& load, const MeshOptions& mesh,
                          const Eigen::MatrixXd& measured) {
  Touch start(design, load, mesh);
  std::shared_ptr<const ConductionField> field;
  if (result_ && result_->touch.design() == design && result_->touch.meshOptions() == mesh) { // keeps the mesh
    start = result_->touch;
    start.setLoad(load);
    if (start.mesh()) field = result_->field; // an indenter elsewhere has a mesh of its own
  }
  const auto work = [this, touch = std::move(start), field,
                     measured](const std::stop_token& stop, JobProgress& progress) mutable -> JobRunner::Taking {
    const auto meshed = [&touch] { return meshFor(touch.design(), touch.load(), touch.meshOptions()); };
    progress.set(-1, "Solving the model view" + (touch.mesh() ? "" : costInBrief(meshCost(touch.design(), meshed()))));
    if (!touch.advance(Stage::Solution, {}, {{}, stop}) && !stop.stop_requested())
      throw Error("the model did not converge under this force; the last result is kept");
    if (stop.stop_requested()) return {};
    touch.advance(Stage::Displacements);
    auto resistances = resistancesOf(touch.design(), *touch.displacements());
    if (touch.design().field() != nullptr) {
      progress.set(-1, "Conduction field of the model view");
      if (!field) field = std::make_shared<const ConductionField>(*touch.problem());
      const auto found = fieldFound(touch, touch.solution()->reachedLoadFraction, *field, stop);
      if (!found) return {};
      resistances = found->read[static_cast<std::size_t>(touch.design().field()->readout)];
    }
    auto fields = std::make_shared<const NodalFields>(touch.problem()->fields(touch.solution()->state()));
    auto result = std::make_shared<const Result>(
        Result{std::move(touch), std::move(fields), std::move(resistances), field, measured});
    return [this, result] { take(result); };
  };
  runner_.start(tr("Solving the model view"), work);
}

void LiveModelView::take(std::shared_ptr<const Result> result) {
  const bool meshChanged = !result_ || result_->touch.mesh() != result->touch.mesh();
  result_ = std::move(result);
  stages_ = result_->touch.stages();
  use_->setEnabled(true);
  displayWords();
  draw(meshChanged);
}

void LiveModelView::displayWords() {
  if (!result_) {
    words_->setText(tr("Press \"Solve for this force\" to show the model's deformation under the decoded force."));
    return;
  }
  const Touch& touch = result_->touch;
  QString words = loadWords(touch.load()) +
                  tr("; at most %1 mm").arg(result_->fields->displacement_mm.colwise().norm().maxCoeff(), 0, 'g', 3);
  if (const auto share = mismatch(result_->resistances, result_->measured))
    words += tr("; its dR/R differs from the board's by %1 % (rms)").arg(100 * *share, 0, 'g', 2);
  words_->setText(words);
}

void LiveModelView::draw(bool meshChanged) {
  if (!result_) return;
  const Touch& touch = result_->touch;
  options_.scale = devicePixelRatioF();
  DeformationState state;
  state.design = &touch.design();
  state.mesh = touch.mesh();
  state.fields = result_->fields.get();
  state.electrodes = touch.displacements();
  state.load = &touch.load();
  view_->show(state, options_, meshChanged);
}

void LiveModelView::setTheme(Theme theme) {
  options_.theme = theme;
  view_->setTheme(theme);
  draw(false);
}

} // namespace palp
