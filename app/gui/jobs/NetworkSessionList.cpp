#include "app/gui/jobs/NetworkSession.h"
#include "app/gui/jobs/samples/ResultFiles.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace palp {

// The list of networks that can be gone back to.

namespace {

/// The sweep acts on no network.
bool equalButForSweep(const NetworkSettings& one, NetworkSettings other) {
  other.sweepFrom = one.sweepFrom;
  other.sweepTo = one.sweepTo;
  other.sweepCount = one.sweepCount;
  return one == other;
}

/// Where it is not known whose test samples the errors are of, those of a repeated training are equal to the last
/// digit.
bool same(const NetworkFit& one, const NetworkFit& other) {
  const Eigen::VectorXd &error = one.error.error.rmsePercentOfRange, &others = other.error.error.rmsePercentOfRange;
  return equalButForSweep(one.settings, other.settings) && one.file == other.file && one.madeFrom == other.madeFrom &&
         error.size() == others.size() && error == others;
}

} // namespace

void NetworkSession::take(const std::shared_ptr<NetworkFit>& fit, const QString& slide) {
  auto& kept = shown_.kept;
  const bool slides = !slide.isEmpty() && slide == lastSlide_ && !kept.empty() && kept.front()->name.isEmpty();
  if (slides) dropKept(0);
  lastSlide_ = slide;
  const auto known = std::find_if(kept.begin(), kept.end(), [&](const auto& other) { return same(*fit, *other); });
  if (known != kept.end()) {
    fit->name = (*known)->name;
    dropKept(static_cast<std::size_t>(known - kept.begin()));
  }
  // The file that it is saved in is named by that time.
  const auto taken = [&](const auto& other) { return other->made == fit->made; };
  while (shown_.removed.contains(fit->made) || std::any_of(kept.begin(), kept.end(), taken))
    fit->made = fit->made.addMSecs(1);
  if (!slides) shown_.before = shown_.fit;
  shown_.fit = fit;
  kept.insert(kept.begin(), fit);
  forgetOldest();
  emit fitChanged();
}

/// Where they were saved their files stay.
void NetworkSession::forgetOldest() {
  auto& kept = shown_.kept;
  const auto unnamed = [](const auto& fit) { return fit->name.isEmpty(); };
  for (auto count = static_cast<std::size_t>(std::count_if(kept.begin(), kept.end(), unnamed)); count > kKeptNetworks;
       --count)
    kept.erase(std::next(std::find_if(kept.rbegin(), kept.rend(), unnamed)).base());
}

void NetworkSession::goBackTo(std::size_t kept) {
  if (!upToDate() || kept >= shown_.kept.size() || waitsForSamples()) return;
  const auto work = [this, old = shown_.kept[kept], samples = shown_.samples](const std::stop_token& stop,
                                                                              JobProgress&) -> JobRunner::Taking {
    auto fit = std::make_shared<NetworkFit>(*old);
    if (fit->triedOn.lock() != samples) {
      tryOn(*fit, *samples, stop);
      fit->triedOn = samples;
    }
    return [this, fit, old, samples] {
      if (samples != shown_.samples) return;
      const auto place = std::find(shown_.kept.begin(), shown_.kept.end(), old);
      if (place != shown_.kept.end() && old->madeFrom == samples->settings)
        *place = fit; // else its errors are of others
      if (shown_.fit && shown_.fit->made != fit->made) shown_.before = shown_.fit;
      shown_.fit = fit;
      lastSlide_.clear(); // what is trained next is added, whatever begins it
      emit fitChanged();
    };
  };
  runner_.start(tr("Testing the network"), work);
}

void NetworkSession::goBackTo(const NetworkSettings& settings) {
  if (!fitIsCurrent() || runner_.running()) return;
  const auto& kept = shown_.kept;
  const auto same = std::find_if(kept.begin(), kept.end(), [&](const auto& fit) {
    return fit->file.isEmpty() && fit->triedOn.lock() == shown_.samples && equalButForSweep(fit->settings, settings);
  });
  if (same != kept.end() && *same != shown_.fit) goBackTo(static_cast<std::size_t>(same - kept.begin()));
}

void NetworkSession::dropKept(std::size_t kept) {
  const auto place = shown_.kept.begin() + static_cast<std::ptrdiff_t>(kept);
  shown_.removed.insert((*place)->made);
  shown_.kept.erase(place);
}

void NetworkSession::takeAway(const std::set<std::size_t>& kept) {
  if (kept.empty() || *kept.rbegin() >= shown_.kept.size()) return;
  auto& away = shown_.away.emplace_back();
  for (const std::size_t place : kept) away.emplace_back(place, shown_.kept[place]);
  for (auto place = kept.rbegin(); place != kept.rend(); ++place) dropKept(*place);
  lastSlide_.clear();
  emit fitChanged();
}

void NetworkSession::bringBack() {
  if (shown_.away.empty()) return;
  auto& kept = shown_.kept;
  for (const auto& [place, fit] : shown_.away.back()) { // the first place first: then the others are right
    kept.insert(kept.begin() + static_cast<std::ptrdiff_t>(std::min(place, kept.size())), fit);
    shown_.removed.erase(fit->made);
  }
  shown_.away.pop_back();
  lastSlide_.clear();
  emit fitChanged();
}

void NetworkSession::rename(std::size_t kept, const QString& name) {
  if (kept >= shown_.kept.size() || shown_.kept[kept]->name == name) return;
  const auto old = shown_.kept[kept];
  const auto fit = std::make_shared<NetworkFit>(*old);
  fit->name = name;
  if (shown_.fit == old) shown_.fit = fit;
  shown_.kept[kept] = fit;
  emit fitChanged();
}

} // namespace palp
