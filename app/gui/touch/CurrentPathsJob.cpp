#include "app/gui/touch/CurrentPathsJob.h"

#include "solver/ConductionField.h"

namespace palp {

namespace {

/// Null: stopped.
std::shared_ptr<const CurrentLines> linesOf(const Touch& touch, double loadFraction, const FieldFound& found,
                                            const ConductionField& field, const std::array<int, 2>& cell,
                                            const std::stop_token& stop) {
  const SensorDesign& design = touch.design();
  const auto [rowWire, columnWire] = cell;
  const LoadIncrement state = stateAt(*touch.solution(), loadFraction);
  const auto current = field.current(state, found.network, design.field()->readout, rowWire, columnWire, 0, stop);
  if (!current) return {};
  const double driven_A = found.network.counts().sumsByWire(current->electrodes_A)(rowWire);
  const ElectrodeDisplacements moved = touch.problem()->electrodes(state);
  Eigen::Matrix3Xd upper = design.upperElectrodes_mm() + moved.upper_mm, lower = design.lowerElectrodes_mm();
  if (design.lowerFollowsRubber) lower += moved.lower_mm;
  CurrentSources sources;
  sources.displacement_mm = state.displacements_mm;
  sources.density = current->currentDensity_A_per_mm2 / driven_A;
  sources.electrodes_mm.resize(3, upper.cols() + lower.cols());
  sources.electrodes_mm << upper, lower;
  sources.electrodes_A = current->electrodes_A / driven_A;
  sources.electrodeRadius_mm = design.field()->electrodeRadius_mm;
  CurrentLines lines = currentLines(*touch.mesh(), sources, stop);
  lines.rowWire = rowWire;
  lines.columnWire = columnWire;
  return std::make_shared<const CurrentLines>(std::move(lines));
}

} // namespace

CurrentPathsJob::CurrentPathsJob(FieldTouch& field, QObject* parent) : QObject(parent), field_(field) {
  connect(&runner_, &JobRunner::failed, this, [this](const QString& sentence) {
    problem_ = sentence;
    emit changed();
  });
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (!cancelled || !wanted_ || lines_) return;
    problem_ = tr("Computation of the current paths was cancelled. Select another cell, or another scene and back, to "
                  "restart it.");
    emit changed();
  });
}

void CurrentPathsJob::want(const Touch& touch, double loadFraction, const std::array<int, 2>& cell) {
  const auto found = field_.found(touch, loadFraction);
  if (!found) { // what there is belongs to another state
    leave();
    return;
  }
  const Wanted wanted{found, touch.design().field()->readout, cell};
  if (wanted_ == wanted) return;
  wanted_ = wanted;
  lines_.reset();
  problem_.clear();
  runner_.start(tr("Following the current"),
                [this, touch, loadFraction, found, cell, before = field_.field(touch)](
                    const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
                  progress.set(-1, "Current paths in the block");
                  const auto field = before ? before : std::make_shared<const ConductionField>(*touch.problem());
                  const auto lines = linesOf(touch, loadFraction, *found, *field, cell, stop);
                  if (!lines) return {};
                  return [this, lines] {
                    lines_ = lines;
                    ++runs_;
                    emit changed();
                  };
                });
}

void CurrentPathsJob::leave() {
  wanted_.reset();
  lines_.reset();
  problem_.clear();
  runner_.cancel();
}

} // namespace palp
