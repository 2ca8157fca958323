#include "app/gui/network/TouchBounds.h"

#include "model/base/Cancelled.h"
#include "model/base/Error.h"

namespace palp {

TouchBounds::TouchBounds(NetworkSession& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (!cancelled || bounds_) return;
    bounds_.emplace(); // after Cancel none is shown
    emit changed();
  });
}

const SampleBounds* TouchBounds::ofTheShown() {
  const NetworkFit* fit = session_.fit();
  if (fit == nullptr) return nullptr;
  const NetworkSettings& settings = fit->settings;
  const bool all = settings.input == InputKind::Resistance && settings.rows == "all";
  if (!session_.upToDate() || !(settings.testNoise > 0) || !all || !session_.samples()->test.hasTouches())
    return nullptr;
  if (samples_.lock() != session_.sharedSamples() || noise_ != settings.testNoise) {
    samples_ = session_.sharedSamples();
    noise_ = settings.testNoise;
    bounds_.reset();
    fit_.reset();
    compute();
  }
  if (bounds_ && fit_.lock() != session_.sharedFit()) computeLearned();
  return bounds_ ? &*bounds_ : nullptr;
}

void TouchBounds::compute() {
  runner_.start(tr("Computing the error bounds"),
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
                  return [this, found = std::move(*found), samples, noise] {
                    if (samples != samples_.lock() || noise != noise_) return;
                    bounds_ = found;
                    emit changed();
                  };
                });
}

void TouchBounds::computeLearned() {
  fit_ = session_.sharedFit();
  bounds_->learned.clear();
  if (session_.fit()->settings.decoder != DecoderKind::TouchInversion) return; // it has learned none
  runner_.start(tr("Computing the error bounds"),
                [this, samples = session_.sharedSamples(), noise = noise_,
                 fit = session_.sharedFit()](const std::stop_token& stop, JobProgress&) -> JobRunner::Taking {
                  auto found = learnedBounds(fit->decoder, samples->test, noise, stop);
                  if (found.empty()) return {};
                  return [this, found = std::move(found), fit] {
                    if (!bounds_ || fit != fit_.lock()) return;
                    bounds_->learned = found;
                    emit changed();
                  };
                });
}

} // namespace palp
