#include "app/study/reports/networks/CrossTable.h"

#include "app/study/decoding/DecoderTraining.h"
#include "app/study/paper/PaperProtocol.h"
#include "app/study/reports/Csv.h"
#include "app/study/reports/ReportPage.h"
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
  std::string name; ///< in words
  std::string key;  ///< in names of figures
  SensorDesign design{};
  SampleSet training{}, test{};
  Eigen::VectorXd rest_ohm{}; ///< row by row, as SampleSet has them
};

class CrossTableWriter {
public:
  CrossTableWriter(const ReportRequest& request, ReportProgress progress, std::stop_token stop)
      : request_(request), law_(*request.design.field()), progress_(std::move(progress)), stop_(std::move(stop)),
        range_N_(request.design.forceRange.high_N - request.design.forceRange.low_N) {}

  std::optional<ReportContent> run() {
    const auto start = std::chrono::steady_clock::now();
    content_.title = "Networks: trained on one law, used on another";
    content_.warnings = designWarnings(request_.design);
    chooseLaws();
    for (std::size_t i = 0; i < laws_.size(); ++i)
      if (!sample(laws_[i], kSampling * static_cast<double>(i) / static_cast<double>(laws_.size()))) return {};
    sayingTheMean();
    for (std::size_t d = 0; d < kCrossDecoders.size(); ++d)
      for (std::size_t i = 0; i < laws_.size(); ++i) {
        if (stop_.stop_requested()) return {};
        say(kSampling + (1 - kSampling) * static_cast<double>(d * laws_.size() + i) /
                            static_cast<double>(kCrossDecoders.size() * laws_.size()),
            name(kCrossDecoders[d]) + " trained on " + laws_[i].name);
        useEverywhere(d, i);
      }
    introduce(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    tables();
    conclude();
    content_.parts.push_back(ReportHeading{"Assumptions"});
    content_.parts.push_back(ReportWords{kFieldAssumed});
    content_.csv = csv_.text();
    return std::move(content_);
  }

private:
  void say(double share, const std::string& what) const {
    if (progress_) progress_(share, what);
  }

  void addField(FieldLaw law, const std::string& name, const std::string& key) {
    SensorDesign design = request_.design;
    design.resistance = law;
    if (const auto faults = check(design); faults.empty())
      laws_.push_back({name, key, design});
    else
      content_.warnings.push_back(name + " is left out: " + faults.front().sentence);
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
    addField(larger,
             std::string(kReadouts.name(law_.readout)) + ", radius " + shortNumber(larger.electrodeRadius_mm) + " mm",
             std::string(kReadouts.name(law_.readout)) + "_larger");
  }

  /// The same forces for every law: the first half of each area's for training. False: stopped.
  bool sample(CrossLaw& law, double share) {
    say(share, "samples by " + law.name);
    law.rest_ohm = resistancesAtRest_ohm(law.design).reshaped<Eigen::RowMajor>();
    SampleRequest wanted;
    wanted.perArea = 2 * request_.perArea;
    wanted.seed = request_.seed;
    wanted.surrogate = true;
    wanted.mesh = request_.mesh;
    wanted.threads = request_.threads;
    SampleGenerator generator(law.design, wanted);
    generator.whileFitting([&](std::size_t done, std::size_t areas) {
      say(share +
              kSampling / static_cast<double>(laws_.size()) * static_cast<double>(done) / static_cast<double>(areas),
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

  void sayingTheMean() {
    const SampleSet& test = laws_.front().test;
    const Eigen::Vector3d mean_N = laws_.front().training.forces_N.rowwise().mean();
    mean_percent_ = percentOfRange(test.forces_N.colwise() - mean_N);
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      csv_.add({"predicting the mean", "", "", "", kForceNames[static_cast<std::size_t>(axis)], mean_percent_(axis)});
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
        const Prediction said = content_.stages.measure(
            "predict", [&] { return predict(trained, Eigen::MatrixXd(gain.asDiagonal() * read), bare); });
        found_.push_back({decoder, trainedOn, usedOn, scaled, percentOfRange(said.forces_N - on.test.forces_N)});
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
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      const char* const force = kForceNames[static_cast<std::size_t>(axis)];
      csv_.add({decoder, from.name, on.name, found.scaled ? "scaled at rest" : "as read", force, found.percent(axis)});
      if (found.scaled)
        content_.figures.emplace_back(decoder + "_trained_" + from.key + "_used_" + on.key + "_" + force + "_percent",
                                      found.percent(axis));
    }
  }

  [[nodiscard]] const Found& at(std::size_t decoder, std::size_t trainedOn, std::size_t usedOn, bool scaled) const {
    return *std::find_if(found_.begin(), found_.end(), [&](const Found& one) {
      return one.decoder == decoder && one.trainedOn == trainedOn && one.usedOn == usedOn && one.scaled == scaled;
    });
  }

  void introduce(double seconds) {
    content_.parts.push_back(ReportWords{
        std::to_string(request_.perArea) + " training forces on each area and as many others for testing (seed " +
        std::to_string(request_.seed) + "), the same for every law, all row-wires, relative noise " +
        text(kShownNoise) +
        " on every resistance in training and in the test. Samples are polynomials of the force for each area, error " +
        shortNumber(surrogateError_) +
        " compared with full solves. Errors are root mean squares over all areas in % of the force range, Fx / Fy / "
        "Fz; a "
        "decoder does not know the area. Computed in " +
        shortNumber(seconds) + " s."});
    content_.parts.push_back(ReportWords{
        "As read: the decoder gets the resistances of the other law as they are. Scaled at rest: each reading is "
        "first multiplied by its value at rest in training over its value at rest in use, one gain per "
        "reading, as in a tare. The field is between spheres of " +
        text(law_.electrodeRadius_mm) + " mm radius unless stated otherwise."});
  }

  void tables() {
    for (std::size_t d = 0; d < kCrossDecoders.size(); ++d) {
      ReportTable table{"Decoder " + name(kCrossDecoders[d]) +
                            ", Fx / Fy / Fz [% of range]; predicting the mean: " + triple(mean_percent_) +
                            ". Green: below half of that in every force, scaled at rest; red: "
                            "some force at least at the error of the mean",
                        {"trained on", "used on", "as read", "scaled at rest"},
                        {},
                        {}};
      for (std::size_t from = 0; from < laws_.size(); ++from)
        for (std::size_t on = 0; on < laws_.size(); ++on) {
          const Eigen::Vector3d& scaled = at(d, from, on, true).percent;
          table.rows.push_back(
              {laws_[from].name, laws_[on].name, triple(at(d, from, on, false).percent), triple(scaled)});
          table.marks.push_back(useful(scaled)                                   ? ReportTable::Mark::Good
                                : (scaled.array() < mean_percent_.array()).all() ? ReportTable::Mark::Doubtful
                                                                                 : ReportTable::Mark::Bad);
        }
      content_.parts.push_back(ReportHeading{"Decoder " + name(kCrossDecoders[d])});
      content_.parts.emplace_back(std::move(table));
    }
  }

  [[nodiscard]] bool useful(const Eigen::Vector3d& percent) const {
    return (percent.array() < kUseful * mean_percent_.array()).all();
  }

  void conclude() {
    std::string carried;
    for (std::size_t from = 0; from < laws_.size(); ++from)
      for (std::size_t on = 0; on < laws_.size(); ++on) {
        if (from == on) continue;
        for (std::size_t d = 0; d < kCrossDecoders.size(); ++d)
          if (useful(at(d, from, on, true).percent))
            carried += (carried.empty() ? "" : "; ") + name(kCrossDecoders[d]) + " from " + laws_[from].name + " to " +
                       laws_[on].name;
      }
    content_.parts.push_back(ReportHeading{"Decoders that work with another law"});
    content_.parts.push_back(ReportWords{
        carried.empty() ? "None: for no pair of laws is a decoder twice as good as predicting the mean in every "
                          "force, not even with each reading scaled at rest."
                        : "Twice as good as predicting the mean in every force, with each reading scaled at rest: " +
                              carried + ". Nothing else."});
    const std::size_t linear = 0, pairs = 0;
    content_.summary = "A linear decoder trained on Eq. (1) and used on " + laws_[own_].name + " is wrong by " +
                       triple(at(linear, pairs, own_, true).percent) +
                       " % of the range of Fx / Fy / Fz with each reading scaled at rest, trained on it by " +
                       triple(at(linear, own_, own_, true).percent) + "; always predicting the mean has an error of " +
                       triple(mean_percent_) + ".";
    const std::size_t last = laws_.size() - 1;
    if (laws_[last].key == std::string(kReadouts.name(law_.readout)) + "_larger")
      content_.summary += " Trained on it and used on electrodes of " + text(kOtherRadius) +
                          " times the radius: " + triple(at(linear, own_, last, true).percent) + ".";
  }

  const ReportRequest& request_;
  const FieldLaw law_;
  ReportProgress progress_;
  std::stop_token stop_;
  Eigen::Vector3d range_N_;
  ReportContent content_;
  Csv csv_{{"decoder", "trained_on", "used_on", "readings", "force", "rmse_percent_of_range"}};
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
