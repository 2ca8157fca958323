#include "app/gui/jobs/FieldTouch.h"

#include "model/FieldAtRest.h"
#include "solver/ConductionField.h"

#include <algorithm>

namespace palp {

namespace {

/// Linear between the equilibria that were computed, as the scenes draw the load path.
LoadIncrement stateAt(const Solution& solution, double fraction) {
  const auto& all = solution.increments;
  const auto after =
      std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.loadFraction >= fraction; });
  if (after == all.end()) return all.back();
  if (after == all.begin() || after->loadFraction == fraction) return *after;
  const LoadIncrement& before = *std::prev(after);
  const double t = (fraction - before.loadFraction) / (after->loadFraction - before.loadFraction);
  LoadIncrement state = *after;
  state.loadFraction = fraction;
  state.displacements_mm = (1 - t) * before.displacements_mm + t * after->displacements_mm;
  state.elementUnknowns = (1 - t) * before.elementUnknowns + t * after->elementUnknowns;
  return state;
}

} // namespace

FieldTouch::FieldTouch(QObject* parent) : QObject(parent) {
  connect(&runner_, &JobRunner::failed, this, [this](const QString& sentence) {
    problem_ = sentence;
    emit changed();
  });
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (!cancelled || !read_.empty()) return;
    problem_ = tr("The field was not computed: stopped. Another scene and back computes it.");
    emit changed();
  });
}

FieldTouch::~FieldTouch() = default;

FieldTouch::Inputs FieldTouch::inputsOf(const Touch& touch, double loadFraction) {
  Inputs inputs{touch.design(), touch.load(), touch.meshOptions(), loadFraction};
  std::get<FieldLaw>(inputs.design.resistance).readout = Readout::Floating;
  return inputs;
}

void FieldTouch::want(const Touch& touch, double loadFraction) {
  if (touch.design().field() == nullptr || touch.solution() == nullptr) return;
  Inputs inputs = inputsOf(touch, loadFraction);
  if (wanted_ == inputs) return;
  wanted_ = std::move(inputs);
  read_.clear();
  problem_.clear();
  auto before = kept_ && kept_->touch.problem() == touch.problem() ? kept_->field : nullptr;
  runner_.start(
      tr("Computing the conduction field"),
      [this, touch, loadFraction, before](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
        progress.set(-1, "The conduction field of the deformed block");
        const auto field = before ? before : std::make_shared<const ConductionField>(*touch.problem());
        const auto now = field->network(stateAt(*touch.solution(), loadFraction), 0, stop);
        if (!now || stop.stop_requested()) return {};
        const TerminalNetwork rest = networkAtRest(touch.design(), *touch.design().field());
        std::vector<TouchResistances> read;
        for (const auto& [readout, name] : kReadouts.all())
          read.push_back(
              {NetworkReading(rest, readout).resistances_ohm(), NetworkReading(*now, readout).resistances_ohm()});
        return [this, read, touch, field] {
          read_ = read;
          kept_ = Kept{touch, field};
          emit changed();
        };
      });
}

std::optional<TouchResistances> FieldTouch::of(const Touch& touch, double loadFraction) const {
  const FieldLaw* law = touch.design().field();
  if (read_.empty() || law == nullptr || wanted_ != inputsOf(touch, loadFraction)) return {};
  return read_[static_cast<std::size_t>(law->readout)];
}

void FieldTouch::retry() {
  if (problem_.isEmpty()) return;
  problem_.clear();
  wanted_.reset();
}

void FieldTouch::forget() {
  runner_.cancel();
  wanted_.reset();
  read_.clear();
  kept_.reset();
  problem_.clear();
}

} // namespace palp
