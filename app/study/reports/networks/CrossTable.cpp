#include "app/study/reports/networks/CrossTable.h"

#include "app/study/decoding/DecoderTraining.h"
#include "app/study/paper/PaperProtocol.h"
#include "app/study/reports/ReportWriter.h"
#include "app/study/reports/layout/FieldResponse.h"
#include "app/study/reports/networks/NoiseAxis.h"
#include "app/study/touch/SampleGenerator.h"
#include "model/FieldAtRest.h"
#include "model/base/Text.h"
#include "nn/NoisyCopies.h"

#include <algorithm>
#include <array>
#include <chrono>

namespace palp {

namespace {

constexpr double kSampling = 0.8;    // of the progress
constexpr double kOtherRadius = 1.5; // times the design's
constexpr double kUseful = 0.5;      // of the error of predicting the mean: below, a decoder is called of use
constexpr std::array kCrossDecoders{DecoderKind::Linear, DecoderKind::Rbf};

/// A law with a read-out, its samples and its readings at rest.
struct CrossLaw {
  std::string name; ///< for readers
  std::string key;  ///< in names of figures
  SensorDesign design{};
  SampleSet training{}, test{};
  Eigen::VectorXd rest_ohm{}; ///< row by row, as SampleSet has them
};

class CrossTableWriter : ReportWriter {
public:
  CrossTableWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : ReportWriter(request, std::move(progress), std::move(stop), "cross-table",
                     {"decoder", "trained_on", "used_on", "readings", "force", "rmse_percent_of_range"}),
        law_(*request.design.field()) {}

  std::optional<ReportContent> run() {
    const auto start = std::chrono::steady_clock::now();
    content_.warnings = designWarnings(request_.design);
    chooseLaws();
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (!sample(laws_[i], kSampling * static_cast<double>(i) / static_cast<double>(laws_.size()))) return {};
    predictTheMean();
    for (std::size_t d = 0; d < kCrossDecoders.size(); ++d)
      for (std::size_t i = 0; i < laws_.size(); ++i) {
        if (stop_.stop_requested()) return {};
        progress(kSampling + (1 - kSampling) * static_cast<double>(d * laws_.size() + i) /
                                 static_cast<double>(kCrossDecoders.size() * laws_.size()),
                 name(kCrossDecoders[d]) + " trained on " + laws_[i].name);
        useEverywhere(d, i);
      }
    introduce(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    tables();
    conclude();
    commonSection("assumptions heading", "field");
    return finished();
  }

private:
  void addField(FieldLaw law, const std::string& name, const std::string& key) {
    SensorDesign design = request_.design;
    design.resistance = law;
    if (const auto faults = check(design); faults.empty())
      laws_.push_back({name, key, design});
    else
      content_.warnings.push_back(words_("left out", {{"law", name}, {"why", faults.front().sentence}}));
  }

  void chooseLaws() {
    SensorDesign pairs = request_.design;
    pairs.resistance = PairsLaw{};
    laws_.push_back({"Eq. (1)", "pairs", pairs});
    for (const auto& [readout, name] : kReadouts.all()) {
      if (readout == Readout::OthersAtHalf && law_.readout != readout) continue; // the worst of them, and dear
      if (readout == law_.readout) own_ = laws_.size();
      FieldLaw law = law_;
      law.readout = readout;
      addField(law, name, name);
    }
    FieldLaw larger = law_;
    larger.electrodeRadius_mm *= kOtherRadius;
    addField(larger, kReadouts.name(law_.readout) + ", radius " + shortNumber(larger.electrodeRadius_mm) + " mm",
             kReadouts.name(law_.readout) + "_larger");
  }

  /// The same forces for every law: the first half of each area's for training. False: stopped.
  bool sample(CrossLaw& law, double share) {
    progress(share, "samples by " + law.name);
    law.rest_ohm = resistancesAtRest_ohm(law.design).reshaped<Eigen::RowMajor>();
    SampleRequest wanted;
    wanted.perArea = 2 * request_.perArea;
    wanted.seed = request_.seed;
    wanted.surrogate = true;
    wanted.mesh = request_.mesh;
    wanted.threads = request_.threads;
    SampleGenerator generator(law.design, wanted);
    generator.whileFitting([&](std::size_t done, std::size_t areas) {
      progress(share + kSampling / static_cast<double>(laws_.size()) * static_cast<double>(done) /
                           static_cast<double>(areas),
               "samples by " + law.name + ", area " + std::to_string(done));
    });
    SampleSet all;
    const std::size_t made = generator.generate(
        {0, generator.total()}, [&](const SampleSet& block) { append(all, block); }, {}, stop_);
    content_.stages.add(generator.stages());
    if (made < generator.total()) return false;
    surrogateError_ = std::max(surrogateError_, generator.measuredError());
    std::vector<Eigen::Index> training, test;
    for (Eigen::Index i = 0; i < all.size(); ++i)
      (i % (2 * request_.perArea) < request_.perArea ? training : test).push_back(i);
    law.training = samplesAt(all, training);
    law.test = samplesAt(all, test);
    return true;
  }

  [[nodiscard]] Eigen::Vector3d percentOfRange(const Eigen::MatrixXd& error_N) const {
    const Eigen::Vector3d rms_N = error_N.cwiseAbs2().rowwise().mean().cwiseSqrt();
    return 100 * rms_N.cwiseQuotient(range_N_);
  }

  void predictTheMean() {
    const SampleSet& test = laws_.front().test;
    const Eigen::Vector3d mean_N = laws_.front().training.forces_N.rowwise().mean();
    mean_percent_ = percentOfRange(test.forces_N.colwise() - mean_N);
    csv_.addForces({{"predicting the mean", mean_percent_}}, {"", "", ""});
  }

  void useEverywhere(std::size_t decoder, std::size_t trainedOn) {
    const CrossLaw& from = laws_[trainedOn];
    TrainOptions options;
    options.input = InputKind::Resistance;
    options.rows = "all";
    options.decoder = kCrossDecoders[decoder];
    options.noise = kShownNoise;
    options.seed = request_.seed;
    options.threads = request_.threads;
    const Decoder trained =
        content_.stages.measure("train", [&] { return trainDecoder(from.training, nullptr, options, stop_); });
    PredictOptions bare;
    bare.area = bare.standardDeviation = false;
    for (std::size_t usedOn = 0; usedOn < laws_.size(); ++usedOn) {
      const CrossLaw& on = laws_[usedOn];
      const Eigen::MatrixXd read =
          noisyCopies(inputsOf(on.test, trained.input), kShownNoise, 1, testSeed(request_.seed));
      for (const bool scaled : {false, true}) {
        const Eigen::VectorXd gain = scaled ? Eigen::VectorXd(from.rest_ohm.cwiseQuotient(on.rest_ohm))
                                            : Eigen::VectorXd(Eigen::VectorXd::Ones(read.rows()));
        const Prediction predicted = content_.stages.measure(
            "predict", [&] { return predict(trained, Eigen::MatrixXd(gain.asDiagonal() * read), bare); });
        found_.push_back({decoder, trainedOn, usedOn, scaled, percentOfRange(predicted.forces_N - on.test.forces_N)});
        record(found_.back());
      }
    }
  }

  struct Found {
    std::size_t decoder, trainedOn, usedOn;
    bool scaled;
    Eigen::Vector3d percent;
  };

  void record(const Found& found) {
    const std::string decoder = name(kCrossDecoders[found.decoder]);
    const CrossLaw &from = laws_[found.trainedOn], &on = laws_[found.usedOn];
    csv_.addForces({{decoder, found.percent}}, {from.name, on.name, found.scaled ? "scaled at rest" : "as read"});
    if (!found.scaled) return;
    for (std::size_t axis = 0; axis < 3; ++axis)
      content_.figures.emplace_back(decoder + "_trained_" + from.key + "_used_" + on.key + "_" + kForceNames[axis] +
                                        "_percent",
                                    found.percent(static_cast<Eigen::Index>(axis)));
  }

  [[nodiscard]] const Found& at(std::size_t decoder, std::size_t trainedOn, std::size_t usedOn, bool scaled) const {
    return *std::find_if(found_.begin(), found_.end(), [&](const Found& one) {
      return one.decoder == decoder && one.trainedOn == trainedOn && one.usedOn == usedOn && one.scaled == scaled;
    });
  }

  void introduce(double seconds) {
    paragraph("scope", {{"samples", request_.perArea},
                        {"seed", request_.seed},
                        {"noise", kShownNoise},
                        {"error", surrogateError_},
                        {"seconds", seconds}});
    paragraph("scaling", {{"radius", text(law_.electrodeRadius_mm)}});
  }

  void tables() {
    for (std::size_t d = 0; d < kCrossDecoders.size(); ++d) {
      const std::string decoder = name(kCrossDecoders[d]);
      ReportTable table = words_.table("decoder table", {{"decoder", decoder}, {"mean", mean_percent_}});
      for (std::size_t from = 0; from < laws_.size(); ++from)
        for (std::size_t on = 0; on < laws_.size(); ++on) {
          const Eigen::Vector3d& scaled = at(d, from, on, true).percent;
          table.add({laws_[from].name, laws_[on].name, at(d, from, on, false).percent, scaled},
                    useful(scaled)                                   ? ReportTable::Mark::Good
                    : (scaled.array() < mean_percent_.array()).all() ? ReportTable::Mark::Doubtful
                                                                     : ReportTable::Mark::Bad);
        }
      heading("decoder heading", {{"decoder", decoder}});
      add(std::move(table));
    }
  }

  [[nodiscard]] bool useful(const Eigen::Vector3d& percent) const {
    return (percent.array() < kUseful * mean_percent_.array()).all();
  }

  void conclude() {
    std::string pairs;
    for (std::size_t from = 0; from < laws_.size(); ++from)
      for (std::size_t on = 0; on < laws_.size(); ++on)
        for (std::size_t d = 0; d < kCrossDecoders.size(); ++d)
          if (from != on && useful(at(d, from, on, true).percent))
            pairs += (pairs.empty() ? "" : "; ") + words_("pair", {{"decoder", name(kCrossDecoders[d])},
                                                                   {"trained", laws_[from].name},
                                                                   {"used", laws_[on].name}});
    heading("conclusion heading");
    if (pairs.empty())
      paragraph("none");
    else
      paragraph("some", {{"pairs", pairs}});
    const std::size_t linear = 0, eq1 = 0;
    content_.summary = words_("summary", {{"law", laws_[own_].name},
                                          {"crossed", at(linear, eq1, own_, true).percent},
                                          {"own", at(linear, own_, own_, true).percent},
                                          {"mean", mean_percent_}});
    const std::size_t last = laws_.size() - 1;
    if (laws_[last].key == kReadouts.name(law_.readout) + "_larger")
      content_.summary +=
          " " + words_("radius summary", {{"times", kOtherRadius}, {"error", at(linear, own_, last, true).percent}});
  }

  const FieldLaw law_;
  std::vector<CrossLaw> laws_;
  std::size_t own_ = 0; ///< of the design itself
  std::vector<Found> found_;
  Eigen::Vector3d mean_percent_;
  double surrogateError_ = 0;
};

} // namespace

std::optional<ReportContent> crossTableReport(const ReportRequest& request, const ReportProgress& progress,
                                              std::stop_token stop) {
  requireSmoothAtRest(request.design);
  return CrossTableWriter(request, progress, std::move(stop)).run();
}

} // namespace palp
