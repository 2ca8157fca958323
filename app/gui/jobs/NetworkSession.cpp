#include "app/gui/jobs/NetworkSession.h"

#include "app/gui/jobs/TimeLeft.h"
#include "app/gui/jobs/samples/ResultFiles.h"
#include "app/gui/jobs/samples/SampleFiles.h"
#include "app/gui/jobs/samples/SampleGeneration.h"
#include "app/gui/jobs/samples/SampleTimes.h"
#include "app/study/decoding/DecoderTraining.h"
#include "io/DecoderFile.h"
#include "model/base/Error.h"
#include "nn/SpreadSweep.h"

#include <QElapsedTimer>

#include <algorithm>
#include <utility>

namespace palp {

namespace {

QString generatingTitle() {
  return QObject::tr("Generating samples");
}

constexpr std::size_t kPastResults = 4; ///< that are kept: an edit and some undoing, other samples

NetworkFit fitOn(const NetworkSamples& samples, const SensorDesign& design, const NetworkSettings& settings,
                 const TrainOptions& options, const std::stop_token& stop, JobProgress& progress) {
  NetworkFit fit;
  fit.settings = settings;
  fit.decoder = trainDecoder(samples.training, samples.ofNoDesign ? nullptr : &design, options, stop,
                             [&, left = LeftOfShares()](double share, const std::string& what) mutable {
                               progress.set(share, what + leftInWords(left.at(share)));
                             });
  tryOn(fit, samples, stop);
  fit.made = QDateTime::currentDateTime();
  fit.madeFrom = samples.settings;
  return fit;
}

} // namespace

namespace {

bool equal(const SampleSet& one, const SampleSet& other) {
  const auto same = [](const auto& a, const auto& b) {
    return a.rows() == b.rows() && (a.rows() == 0 || (a.cols() == b.cols() && a == b)); // what has no rows is not there
  };
  return one.origin.designFingerprint == other.origin.designFingerprint && same(one.area, other.area) &&
         std::all_of(kSampleParts.begin(), kSampleParts.end(),
                     [&](const auto part) { return same(one.*part, other.*part); });
}

bool equal(const NetworkSamples& one, const NetworkSamples& other) {
  return equal(one.training, other.training) && equal(one.test, other.test);
}

} // namespace

QStringList NetworkResults::listed() const {
  QStringList all;
  for (const auto& network : kept) all << network->made.toString(Qt::ISODateWithMs) + " " + network->name;
  for (const SweepPoint& point : sweep) all << QString("spread %1, %2 s").arg(point.spread).arg(point.report.seconds);
  for (const DecoderTrial& trial : trials)
    all << QString("decoder %1, %2 s").arg(QString::fromStdString(palp::name(trial.kind))).arg(trial.seconds);
  return all;
}

NetworkSession::NetworkSession(QObject* parent) : QObject(parent) {
  connect(&runner_, &JobRunner::progressed, this, &NetworkSession::drain);
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    const bool opened = std::exchange(openingResults_, false);
    if (cancelled || opened) emit samplesChanged();
  });
}

NetworkSession::~NetworkSession() = default;

std::array<std::size_t, 2> NetworkSession::stoppedAt() const {
  return generation_ && !runner_.running() ? generation_->state() : std::array<std::size_t, 2>{0, 0};
}

void NetworkSession::show(NetworkResults results) {
  if (results.kept.empty() && results.design == shown_.design) {
    results.kept = shown_.kept;
    results.away = shown_.away;
  }
  results.removed.insert(shown_.removed.begin(), shown_.removed.end());
  if (results.kept.empty() && results.fit) results.kept = {results.fit};
  if (shown_.samples) past_.push_front(std::move(shown_));
  std::erase_if(past_, [&](const NetworkResults& past) { return past.samples == results.samples; }); // shown again
  shown_ = std::move(results);
  forgetOldestPast();
  emit samplesChanged();
  emit fitChanged();
  emit sweepChanged();
  emit trialsChanged();
}

/// Other samples of a design go before the last results of one: undoing brings its design's back.
void NetworkSession::forgetOldestPast() {
  while (past_.size() > kPastResults) {
    std::set<const NetworkResults*> last;
    for (auto one = past_.begin(); one != past_.end(); ++one) {
      const auto same = [&](const NetworkResults& other) { return other.design == one->design; };
      if (one->design != shown_.design && std::none_of(past_.begin(), one, same)) last.insert(&*one);
    }
    const auto goes = std::find_if(past_.rbegin(), past_.rend(), [&](const auto& one) { return !last.contains(&one); });
    past_.erase(goes == past_.rend() ? std::prev(past_.end()) : std::prev(goes.base()));
  }
}

void NetworkSession::setDesign(const SensorDesign& design) {
  if (design == design_) return;
  design_ = design;
  generation_.reset();
  runner_.cancel();
  const auto past = std::find_if(past_.begin(), past_.end(), [&](const auto& one) { return one.design == design; });
  if (past != past_.end() && shown_.design != design)
    show(NetworkResults(*past));
  else
    emit samplesChanged(); // they are of another design now, or of this one again
}

void NetworkSession::clear() {
  runner_.cancel();
  generation_.reset();
  past_.clear();
  shown_ = {};
  show({});
}

void NetworkSession::generate(const SampleSettings& settings, const MeshOptions& mesh) {
  emit memoryNeeded();
  if (!generation_ || !generation_->is(settings, mesh))
    generation_ = std::make_shared<SampleGeneration>(settings, mesh, design_);
  const auto work = [this, generation = generation_](const std::stop_token& stop,
                                                     JobProgress& progress) -> JobRunner::Taking {
    StageLog stages;
    if (!generation->make(stages, stop, progress)) return {};
    return [this, generation, stages] {
      NetworkResults results;
      results.design = generation->design();
      results.samples = generation->samples();
      if (generation->inOneRun())
        rememberSampleTime(generation->settings(), generation->design(), generation->mesh(), results.samples->seconds);
      if (generation_ == generation) generation_.reset();
      stages_.add(stages);
      show(std::move(results));
    };
  };
  runner_.start(generatingTitle(), work, JobRunner::Loss::Work);
}

bool NetworkSession::generating() const {
  return runner_.running() && runner_.title() == generatingTitle();
}

bool NetworkSession::waitsForSamples() {
  if (!generating()) return false;
  emit note(tr("Samples are being generated; wait for them, or cancel the generation."));
  return true;
}

bool NetworkSession::fitIsCurrent() const {
  return upToDate() && shown_.fit && shown_.fit->triedOn.lock() == shown_.samples;
}

void NetworkSession::train(const NetworkSettings& settings, const QString& slide) {
  if (!upToDate() || waitsForSamples()) return;
  const auto work = [this, settings, slide, design = design_, samples = shown_.samples](
                        const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
    StageLog stages;
    const auto fit = stages.measure("train", [&] {
      return std::make_shared<NetworkFit>(fitOn(*samples, design, settings, settings.trainOptions(), stop, progress));
    });
    fit->triedOn = samples;
    return [this, fit, slide, samples, stages] {
      if (samples != shown_.samples) return;
      stages_.add(stages);
      take(fit, slide);
    };
  };
  runner_.start(tr("Training"), work, JobRunner::Loss::Work);
}

void NetworkSession::sweep(const NetworkSettings& settings) {
  if (!upToDate() || waitsForSamples()) return;
  shown_.sweep.clear();
  shown_.sweepSettings = settings;
  rows_ = std::make_shared<Rows>();
  emit sweepChanged();
  const auto work = [this, settings, design = design_, samples = shown_.samples,
                     rows = rows_](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
    const std::vector<double> spreads = logarithmicRange(settings.sweepFrom, settings.sweepTo, settings.sweepCount);
    const auto all = static_cast<double>(spreads.size());
    QElapsedTimer clock;
    clock.start();
    const TimeLeft left; // one fit takes as long as another
    for (std::size_t k = 0; k < spreads.size() && !stop.stop_requested(); ++k) {
      const auto done = static_cast<double>(k);
      progress.set(done / all, "Spread " + std::to_string(k + 1) + " of " + std::to_string(spreads.size()) +
                                   leftInWords(left.left_s(done, all, 1e-3 * static_cast<double>(clock.elapsed()))));
      TrainOptions options = settings.trainOptions();
      options.spread = spreads[k];
      JobProgress unseen;
      const NetworkFit fit = fitOn(*samples, design, settings, options, stop, unseen);
      const std::lock_guard lock(rows->mutex);
      rows->points.push_back({spreads[k], fit.error.error, fit.decoder.report});
    }
    return [this] { drain(); };
  };
  runner_.start(tr("Sweeping the spread"), work, JobRunner::Loss::Work);
}

void NetworkSession::compare(const NetworkSettings& settings) {
  if (!upToDate() || waitsForSamples()) return;
  shown_.trials.clear();
  shown_.trialsSettings = settings;
  rows_ = std::make_shared<Rows>();
  emit trialsChanged();
  const auto work = [this, settings, design = design_, samples = shown_.samples,
                     rows = rows_](const std::stop_token& stop, JobProgress& progress) -> JobRunner::Taking {
    const std::vector<DecoderKind> kinds = decodersWith(
        settings.target == DecoderTarget::ForceAndPlace ? &DecoderTraits::givesPosition : &DecoderTraits::ofAreas);
    for (std::size_t k = 0; k < kinds.size() && !stop.stop_requested(); ++k) {
      progress.set(static_cast<double>(k) / static_cast<double>(kinds.size()), "Training " + name(kinds[k]));
      TrainOptions options = settings.trainOptions();
      options.decoder = kinds[k];
      JobProgress unseen;
      DecoderTrial trial;
      trial.kind = kinds[k];
      try {
        const NetworkFit fit = fitOn(*samples, design, settings, options, stop, unseen);
        trial.error = fit.error.error;
        trial.place = fit.error.place;
        trial.spread = fit.decoder.report.spread;
        trial.seconds = fit.decoder.report.seconds;
        trial.microsecondsPerSample = fit.prediction.microsecondsPerSample;
      } catch (const std::exception& refusal) {
        trial.refusal = QString::fromStdString(refusal.what());
      }
      if (stop.stop_requested()) break;
      const std::lock_guard lock(rows->mutex);
      rows->trials.push_back(std::move(trial));
    }
    return [this] { drain(); };
  };
  runner_.start(tr("Comparing decoders"), work, JobRunner::Loss::Work);
}

void NetworkSession::drain() {
  if (!rows_) return;
  std::vector<SweepPoint> points;
  std::vector<DecoderTrial> trials;
  {
    const std::lock_guard lock(rows_->mutex);
    points.swap(rows_->points);
    trials.swap(rows_->trials);
  }
  if (!points.empty()) {
    shown_.sweep.insert(shown_.sweep.end(), points.begin(), points.end());
    emit sweepChanged();
  }
  if (!trials.empty()) {
    shown_.trials.insert(shown_.trials.end(), trials.begin(), trials.end());
    emit trialsChanged();
  }
}

void NetworkSession::open(const std::filesystem::path& file) {
  if (!upToDate()) throw Error("the network cannot be tested: generate samples first");
  if (waitsForSamples()) return;
  const auto work = [this, file, samples = shown_.samples](const std::stop_token&, JobProgress&) -> JobRunner::Taking {
    const auto fit = std::make_shared<NetworkFit>(*triedOn(readNetwork(file), *samples));
    fit->file = QString::fromStdString(file.string());
    fit->triedOn = samples;
    return [this, fit, samples] {
      if (samples == shown_.samples) take(fit, {});
    };
  };
  runner_.start(tr("Testing the network"), work);
}

void NetworkSession::openSamples(const std::vector<std::filesystem::path>& files) {
  const auto work = [this, files, design = design_](const std::stop_token& stop, JobProgress&) -> JobRunner::Taking {
    NetworkResults results;
    results.design = design;
    results.samples = std::make_shared<const NetworkSamples>(openSampleFiles(files, design, stop));
    return [this, results] {
      const QString file = results.samples->file;
      if (results.design != design_) return;
      if (upToDate() && equal(*results.samples, *shown_.samples))
        emit note(tr("%1 contains the samples already loaded; existing results are kept.").arg(results.samples->file));
      else
        showOpened(results);
      emit samplesOpened(file);
    };
  };
  runner_.start(tr("Opening samples"), work);
}

/// With the network and the sweep that were made of the same samples before, where there are some.
void NetworkSession::showOpened(NetworkResults results) {
  const auto before = std::find_if(past_.begin(), past_.end(), [&](const NetworkResults& past) {
    return past.design == results.design && equal(*past.samples, *results.samples);
  });
  const QString file = results.samples->file;
  const bool known = before != past_.end();
  if (known) results = NetworkResults(*before);
  results.openedFrom = file;
  results.kept.clear(); // the list that is shown has grown since
  const SampleSettings settings = results.samples->settings;
  show(std::move(results));
  if (known) return emit note(tr("These samples of %1 were loaded earlier; their results were restored.").arg(file));
  const auto back = [this, settings] { // the newest that was made from them
    const auto of = std::find_if(shown_.kept.begin(), shown_.kept.end(),
                                 [&](const auto& network) { return network->madeFrom == settings; });
    if (of != shown_.kept.end() && shown_.fit == nullptr) goBackTo(static_cast<std::size_t>(of - shown_.kept.begin()));
  };
  QMetaObject::invokeMethod(this, back, Qt::QueuedConnection); // when this job is done
}

void NetworkSession::openResults(const std::filesystem::path& folder,
                                 const std::function<void(const OpenedResults&)>& opened) {
  const auto work = [this, folder, opened, design = design_](const std::stop_token& stop,
                                                             JobProgress& progress) -> JobRunner::Taking {
    const auto found = std::make_shared<const OpenedResults>(palp::openResults(
        folder, design, stop, [&progress](double share, const std::string& what) { progress.set(share, what); }));
    return [this, found, opened] {
      if (found->results.design != design_) return;
      if (found->results.samples) show(found->results);
      opened(*found);
    };
  };
  runner_.start(tr("Opening samples and networks"), work);
  openingResults_ = true;
  emit samplesChanged(); // there are none yet, for another reason
}

void NetworkSession::saveSamples(const std::filesystem::path& file, const std::function<void()>& then) {
  const auto work = [this, file, then, samples = shown_.samples](const auto&, JobProgress&) {
    saveSampleFiles(file, *samples);
    return [this, file, then] {
      emit saved({file, testFileOf(file)});
      if (then) then();
    };
  };
  writer_.start(tr("Saving samples"), work);
}

void NetworkSession::saveNetwork(const std::filesystem::path& file, const std::function<void()>& then) {
  const auto work = [this, file, then, fit = shown_.fit](const auto&, JobProgress&) {
    writeNetwork(fit->decoder, file);
    return [this, file, then] {
      emit saved({file});
      if (then) then();
    };
  };
  writer_.start(tr("Saving the network"), work);
}

void NetworkSession::saveResults(const std::filesystem::path& folder,
                                 const std::shared_ptr<const std::set<std::filesystem::path>>& ours,
                                 const std::function<void(const NetworkResults&, const QStringList&)>& saved) {
  writer_.start(tr("Saving samples and network"), [folder, ours, saved, results = shown_](const auto&, JobProgress&) {
    QStringList said;
    for (const std::string& sentence : palp::saveResults(folder, results, *ours))
      said << QString::fromStdString(sentence);
    return [saved, results, said] { saved(results, said); };
  });
}

} // namespace palp
