#include "app/gui/jobs/FieldTouch.h"

#include "model/FieldAtRest.h"
#include "solver/ConductionField.h"

#include <algorithm>

namespace palp {

namespace {

constexpr int kKeepFieldFor_ms = 5000;
constexpr std::size_t kKnownStates = 8; ///< a hundred kilobytes each: scrubbing there and back

/// As it is computed, for all read-outs.
SensorDesign readSomehow(SensorDesign design) {
  std::get<FieldLaw>(design.resistance).readout = Readout::Floating;
  return design;
}

} // namespace

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

std::shared_ptr<const FieldFound> fieldFound(const Touch& touch, double loadFraction, const ConductionField& field,
                                             const std::stop_token& stop) {
  auto now = field.network(stateAt(*touch.solution(), loadFraction), 0, stop);
  if (!now || stop.stop_requested()) return {};
  const TerminalNetwork rest = networkAtRest(touch.design(), *touch.design().field());
  auto found = std::make_shared<FieldFound>(FieldFound{std::move(*now), {}});
  for (const auto& [readout, name] : kReadouts.all())
    found->read.push_back(
        {NetworkReading(rest, readout).resistances_ohm(), NetworkReading(found->network, readout).resistances_ohm()});
  return found;
}

std::optional<TouchResistances> fieldResistances(const Touch& touch, double loadFraction, const std::stop_token& stop) {
  const auto found = fieldFound(touch, loadFraction, ConductionField(*touch.problem()), stop);
  if (!found) return {};
  return found->read[static_cast<std::size_t>(touch.design().field()->readout)];
}

FieldTouch::FieldTouch(QObject* parent) : QObject(parent) {
  idle_.setSingleShot(true);
  idle_.setInterval(kKeepFieldFor_ms);
  connect(&idle_, &QTimer::timeout, this, [this] { kept_.reset(); });
  connect(&runner_, &JobRunner::finished, &idle_, qOverload<>(&QTimer::start));
  connect(&runner_, &JobRunner::failed, this, [this](const QString& sentence) {
    problem_ = sentence;
    emit changed();
  });
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (!cancelled || !wanted_ || find(*wanted_)) return;
    problem_ = tr("Computation of the field was cancelled. Switch to another scene and back to restart it.");
    emit changed();
  });
}

FieldTouch::~FieldTouch() = default;

FieldTouch::Inputs FieldTouch::inputsOf(const Touch& touch, double loadFraction) {
  return {readSomehow(touch.design()), touch.load(), touch.path(), touch.meshOptions(), loadFraction};
}

std::shared_ptr<const FieldFound> FieldTouch::find(const Inputs& inputs) const {
  const auto known = std::find_if(known_.begin(), known_.end(), [&](const Known& one) { return one.inputs == inputs; });
  return known == known_.end() ? nullptr : known->found;
}

void FieldTouch::want(const Touch& touch, double loadFraction) {
  if (touch.design().field() == nullptr || touch.solution() == nullptr) return;
  Inputs inputs = inputsOf(touch, loadFraction);
  if (wanted_ == inputs) return;
  wanted_ = inputs;
  problem_.clear();
  if (find(inputs)) {
    runner_.cancel(); // another state, which nobody looks at any more
    return;
  }
  runner_.start(tr("Computing the conduction field"),
                [this, touch, inputs, before = field(touch)](const std::stop_token& stop,
                                                             JobProgress& progress) -> JobRunner::Taking {
                  progress.set(-1, "The conduction field of the deformed block");
                  const auto field = before ? before : std::make_shared<const ConductionField>(*touch.problem());
                  const auto found = fieldFound(touch, inputs.loadFraction, *field, stop);
                  if (!found) return {};
                  return [this, found, inputs, touch, field] {
                    known_.push_front({inputs, found});
                    const Inputs end = inputsOf(touch, touch.solution()->reachedLoadFraction);
                    while (known_.size() > kKnownStates) {
                      auto oldest = std::prev(known_.end());
                      if (oldest->inputs == end) --oldest; // its colours hold on the complete load path
                      known_.erase(oldest);
                    }
                    kept_ = Kept{touch, field};
                    ++runs_;
                    emit changed();
                  };
                });
}

std::shared_ptr<const ConductionField> FieldTouch::field(const Touch& touch) const {
  const bool same = kept_ && kept_->touch.mesh() == touch.mesh() && touch.design().field() != nullptr &&
                    readSomehow(kept_->touch.design()) == readSomehow(touch.design());
  return same ? kept_->field : nullptr;
}

std::shared_ptr<const FieldFound> FieldTouch::found(const Touch& touch, double loadFraction) const {
  return touch.design().field() == nullptr ? nullptr : find(inputsOf(touch, loadFraction));
}

std::optional<TouchResistances> FieldTouch::of(const Touch& touch, double loadFraction) const {
  const auto known = found(touch, loadFraction);
  if (!known) return {};
  return known->read[static_cast<std::size_t>(touch.design().field()->readout)];
}

void FieldTouch::retry() {
  if (problem_.isEmpty()) return;
  problem_.clear();
  wanted_.reset();
  emit changed(); // the scene that shows it requests it again
}

void FieldTouch::leave() {
  wanted_.reset();
  problem_.clear();
  runner_.cancel();
}

} // namespace palp
