#include "app/cli/commands/listen/ListenLabel.h"

#include "app/cli/Options.h"
#include "app/cli/commands/listen/ListenOutput.h"
#include "app/study/live/LabelledFrames.h"
#include "io/DesignFile.h"

#include <algorithm>
#include <iostream>

namespace palp {

namespace {

constexpr int kUnknownNoise = 8;      // frames from which the noise is known: before, no force exceeds it
constexpr double kSteadyTouch = 0.05; // of a force that rests on the sensor, that it may move

KnownTouch labelledTouch(const std::string& label, const SensorDesign& design) {
  if (!label.starts_with('@')) return {areaLoadOption("--label", label, design)};
  const auto [place_mm, force_N] = placedForceOption("--label", label.substr(1));
  return knownTouch(design, place_mm, force_N);
}

} // namespace

void LabelArguments::declare(Command command) {
  command.group("Labelled frames");
  command.option(
      "--label", label, "LOAD",
      "known load on the sensor, for palp calibrate: AREA:FX,FY,FZ [N], or @X,Y:FX,FY,FZ [mm, N] for a touch at a "
      "position; refused if the network predicts no force, another sign, another area or a changing load");
  command.option("--append", append, "FILE", "file of labelled frames to append the mean to");
  command.option("--average", average, "N", "number of frames in the mean (default 50)");
}

std::optional<LabelledMean> labelledMean(const LabelArguments& arguments, const LiveOptions& options) {
  if (arguments.label.empty() != arguments.append.empty())
    throw UsageError("--label and --append go together: --label AREA:FX,FY,FZ (or @X,Y:FX,FY,FZ) --append frames.csv");
  if (arguments.label.empty()) return {};
  if (!options.decoder) throw UsageError("--label: needs --network, whose design the frames belong to");
  return LabelledMean(arguments, *options.decoder, options.design.value_or(paperDesign()));
}

LabelledMean::LabelledMean(const LabelArguments& arguments, const Decoder& decoder, const SensorDesign& design)
    : label_(arguments.label), file_(arguments.append),
      wanted_(wholeNumber("--average", arguments.average, 1, 100'000)), decoder_(decoder),
      touch_(labelledTouch(arguments.label, design)), mean_(decoder, design, touch_) {}

void LabelledMean::add(const DecodedForces& forces) {
  if (done() || !forces.valid) return;
  mean_.add(forces);
  last_ = forces;
}

std::string LabelledMean::doubt() const {
  if (const std::string moved = mean_.moved(); !moved.empty())
    return "the load moved while it was averaged (" + moved + "); hold it still";
  if (const std::string other = mean_.onAnotherArea(); !other.empty()) return other;
  DecodedForces reads = last_;
  if (const Eigen::Vector3d mean_N = mean_.predicted_N(); mean_N.allFinite()) reads.forces_N = mean_N;
  return labelAgainstReading(touch_.load.force_N, reads, touch_.load.area, decoder_);
}

bool LabelledMean::append(Session& session, bool anyway) const {
  if (mean_.count() == 0) return false;
  if (const std::string against = doubt(); !against.empty()) {
    if (!anyway)
      throw Error("--label " + label_ + ": " + against + " (nothing was added to " + file_ +
                  "; --force adds it nevertheless)");
    warnOnce(session, "--label " + label_ + ": " + against + " (added nevertheless)");
  }
  if (!done())
    warnOnce(session, "--average: " + std::to_string(mean_.count()) + " of " + std::to_string(wanted_) +
                          " frames came before the end; their mean was added");
  appendFrames(file_, mean_.sample());
  session.result["averaged_frames"] = mean_.count();
  session.result["file"] = file_;
  if (!session.json)
    std::cout << "1 labelled frame added to " << file_ << ": the mean of " << mean_.count() << " under " << label_
              << std::endl;
  return true;
}

void TareQuestion::add(const DecodedForces& forces) {
  if (seen_ >= wanted_ || !forces.valid) return;
  ++seen_;
  if (seen_ <= kUnknownNoise) return;
  const bool shown = std::find(forces.shown.begin(), forces.shown.end(), true) != forces.shown.end();
  const double size_N = std::sqrt(forces.forces_N.colwise().squaredNorm().maxCoeff());
  if (shown && !forces.doubted) {
    least_N_ = held_ == 0 ? size_N : std::min(least_N_, size_N);
    most_N_ = std::max(most_N_, size_N);
    ++held_;
  }
  if (seen_ < wanted_ || held_ < wanted_ - kUnknownNoise || most_N_ - least_N_ > kSteadyTouch * most_N_) return;
  Eigen::Index column = 0;
  forces.forces_N.colwise().squaredNorm().maxCoeff(&column);
  throw Error("--tare: the network predicts a steady " + inNewton(forces.forces_N.col(column)) +
              " on the sensor since the start; after a tare this force would read as zero: remove the load, or tare "
              "nevertheless with --force");
}

} // namespace palp
