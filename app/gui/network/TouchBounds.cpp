#include "app/gui/network/TouchBounds.h"

#include "model/base/Cancelled.h"
#include "model/base/Error.h"

namespace palp {

TouchBounds::TouchBounds(NetworkSession& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (!cancelled || bounds_) return;
    bounds_ = std::make_shared<const SampleBounds>(); // who cancels wants none
    emit changed();
  });
}

const SampleBounds* TouchBounds::of(const NetworkSettings& settings) {
  const bool all = settings.input == InputKind::Resistance && settings.rows == "all";
  if (!session_.upToDate() || !(settings.testNoise > 0) || !all || !session_.samples()->test.hasTouches())
    return nullptr;
  if (samples_.lock() != session_.sharedSamples() || noise_ != settings.testNoise) {
    samples_ = session_.sharedSamples();
    noise_ = settings.testNoise;
    bounds_.reset();
    compute();
  }
  return bounds_.get();
}

void TouchBounds::compute() {
  runner_.start(tr("Bounding the errors"),
                [this, samples = session_.sharedSamples(), noise = noise_,
                 design = session_.design()](const std::stop_token& stop, JobProgress&) -> JobRunner::Taking {
                  std::optional<SampleBounds> found;
                  try {
                    found = touchBounds(samples->test, design, noise, samples->mesh.value_or(MeshOptions()), 0, stop);
                  } catch (const Cancelled&) {
                    throw;
                  } catch (const Error&) { // an indenter without a place along x and y, say: there is none
                    found.emplace();
                  }
                  if (!found) return {};
                  auto bounds = std::make_shared<const SampleBounds>(std::move(*found));
                  return [this, bounds, samples, noise] {
                    if (samples != samples_.lock() || noise != noise_) return;
                    bounds_ = bounds;
                    emit changed();
                  };
                });
}

} // namespace palp
