#pragma once

#include "app/gui/jobs/JobRunner.h"
#include "app/gui/project/Project.h"
#include "app/study/StageLog.h"
#include "app/study/decoding/Prediction.h"

#include <QDateTime>
#include <QStringList>

#include <array>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <vector>

namespace palp {

class SampleGeneration;
struct OpenedResults;

/// Training and test samples of the design, forces on its areas or touches.
struct NetworkSamples {
  SampleSet training;
  SampleSet test;
  double batchError = 0;   ///< relative, against full Newton; 0: not measured here
  int redrawn = 0;         ///< touches without an equilibrium, in whose places others were drawn
  QString doubts;          ///< samples for which full Newton finds another equilibrium; empty: none is known
  double seconds = 0;      ///< that making them took; 0: not known
  QString file;            ///< that they were opened from; empty: made here
  bool split = false;      ///< the test samples were taken from the file of the training samples
  bool ofNoDesign = false; ///< imported, of another rig than the design that is open
  SampleSettings settings;
  std::optional<MeshOptions> mesh = {}; ///< that they were solved on; none: they were opened
};

/// A trained decoder and its predictions of the test samples.
struct NetworkFit {
  NetworkSettings settings;
  Decoder decoder;
  Prediction prediction;
  DecoderError error;
  QDateTime made;
  QString name;                                ///< that the user gave it; empty: none
  QString file;                                ///< that it was opened from; empty: trained here
  SampleSettings madeFrom;                     ///< the samples that it was trained with or tried on
  std::weak_ptr<const NetworkSamples> triedOn; ///< whose test samples the prediction is of
};

/// One spread of a sweep.
struct SweepPoint {
  double spread = 0;
  PredictionError error;
  FitReport report;
};

/// One kind of decoder, trained on the same samples as the others.
struct DecoderTrial {
  DecoderKind kind = DecoderKind::Rbf;
  PredictionError error;
  std::optional<PlaceError> place{}; ///< where places were learned
  double spread = 0;                 ///< that it was trained at; 0: it has none
  double seconds = 0;                ///< of the training
  double microsecondsPerSample = 0;
  QString refusal; ///< why it cannot be trained; empty where it was
};

/// What was made of one design.
struct NetworkResults {
  SensorDesign design;
  std::shared_ptr<const NetworkSamples> samples;
  QString openedFrom; ///< the file that they were opened from last; empty: the samples say it
  std::shared_ptr<const NetworkFit> fit;
  std::shared_ptr<const NetworkFit> before;            ///< that was shown before it; to compare with
  std::vector<std::shared_ptr<const NetworkFit>> kept; ///< that can be gone back to, the newest first
  std::set<QDateTime> removed;                         ///< when the networks were made that were taken off that list
  /// Networks that were removed from it, the last ones last, each with its index; not written to files.
  std::vector<std::vector<std::pair<std::size_t, std::shared_ptr<const NetworkFit>>>> away;
  std::vector<SweepPoint> sweep;
  NetworkSettings sweepSettings;
  std::vector<DecoderTrial> trials;
  NetworkSettings trialsSettings;

  /// When each network of the list was made, and its name, and what was swept and compared: another list is another
  /// state of the work.
  [[nodiscard]] QStringList listed() const;
};

/// The samples and networks behind the Network scene: made in the background, only on request. They stay with the
/// design that they were made of: another design leaves them to be looked at as those of an earlier one until it has
/// samples of its own, and the design they belong to brings them back.
class NetworkSession : public QObject {
  Q_OBJECT

public:
  explicit NetworkSession(QObject* parent = nullptr);
  ~NetworkSession() override;

  /// The design that samples are made of from now on.
  void setDesign(const SensorDesign& design);
  /// Gives everything back that was made of any design.
  void clear();
  /// Continues where the same samples were stopped before.
  void generate(const SampleSettings& samples, const MeshOptions& mesh);
  /// The list keeps every network that was trained, those of equal settings and results once. `slide`: the movement
  /// of a slider that it follows, of which the list keeps the last network alone; empty: of none.
  void train(const NetworkSettings& settings, const QString& slide = {});
  void sweep(const NetworkSettings& settings);
  /// Trains every kind of decoder with the same input, rows, target and noise.
  void compare(const NetworkSettings& settings);
  void cancel() { runner_.cancel(); }
  /// Tries a network from a file on the test samples; the job fails where it cannot be read or does not fit them.
  /// Throws Error where there are no samples.
  void open(const std::filesystem::path& file);
  /// Samples of files in place of generated ones; the job fails where they cannot be (SampleFiles.h).
  void openSamples(const std::vector<std::filesystem::path>& files);
  /// What a folder keeps of this design, as far as it can be opened; then `opened` is called.
  void openResults(const std::filesystem::path& folder, const std::function<void(const OpenedResults&)>& opened);
  /// The samples in NAME.csv and NAME-test.csv; there must be some. `then` is called when they are written.
  void saveSamples(const std::filesystem::path& file, const std::function<void()>& then = {});
  /// The network that is shown, which must be there; `then` is called when it is written.
  void saveNetwork(const std::filesystem::path& file, const std::function<void()>& then = {});
  /// Samples and networks in a folder (saveResults in ResultFiles.h); then `saved` is called with them and with what is
  /// to be reported. `ours` is looked at when the orders before this one are done, and changed by `saved` only.
  void saveResults(const std::filesystem::path& folder,
                   const std::shared_ptr<const std::set<std::filesystem::path>>& ours,
                   const std::function<void(const NetworkResults&, const QStringList&)>& saved);

  /// Of files that hold results: what the Network scene shows until the next work begins.
  void sayProblem(const QString& sentence) { emit problem(sentence); }

  /// Samples are being made: what needs samples waits for them.
  [[nodiscard]] bool generating() const;
  [[nodiscard]] bool working() const { return runner_.running(); }

  /// The results next to the project file are being opened.
  [[nodiscard]] bool openingResults() const { return openingResults_; }

  /// The project's design now.
  [[nodiscard]] const SensorDesign& design() const { return design_; }
  [[nodiscard]] const NetworkResults& results() const { return shown_; }
  [[nodiscard]] const NetworkSamples* samples() const { return shown_.samples.get(); }
  /// There are samples, and they are of the design as it is now.
  [[nodiscard]] bool upToDate() const { return shown_.samples && shown_.design == design_; }
  /// The same, for a job that outlives them.
  [[nodiscard]] std::shared_ptr<const NetworkSamples> sharedSamples() const { return shown_.samples; }
  [[nodiscard]] const NetworkFit* fit() const { return shown_.fit.get(); }
  [[nodiscard]] std::shared_ptr<const NetworkFit> sharedFit() const { return shown_.fit; }
  /// The fit is of the loaded samples, and these are of the present design.
  [[nodiscard]] bool fitIsCurrent() const;
  /// Networks of this design that can be gone back to, the newest first.
  [[nodiscard]] const std::vector<std::shared_ptr<const NetworkFit>>& kept() const { return shown_.kept; }
  /// The network that was shown before the one that is now, of the same samples; null where none was.
  [[nodiscard]] const NetworkFit* before() const { return shown_.before.get(); }
  /// Shows one of them again, evaluated on the loaded samples.
  void goBackTo(std::size_t kept);
  /// Shows the newest of them that was trained with these settings on the loaded samples, where there is one.
  void goBackTo(const NetworkSettings& settings);
  void takeAway(const std::set<std::size_t>& kept);
  /// Restores the networks that were removed last, at their indices.
  void bringBack();
  [[nodiscard]] bool canBringBack() const { return !shown_.away.empty(); }
  /// Calls one of them by a name; empty: takes its name away.
  void rename(std::size_t kept, const QString& name);
  /// Number of networks that stay in the list, apart from those with a name.
  static constexpr std::size_t kKeptNetworks = 50;
  [[nodiscard]] const std::vector<SweepPoint>& sweepPoints() const { return shown_.sweep; }
  [[nodiscard]] const NetworkSettings& sweepSettings() const { return shown_.sweepSettings; }
  [[nodiscard]] const std::vector<DecoderTrial>& trials() const { return shown_.trials; }
  [[nodiscard]] const NetworkSettings& trialsSettings() const { return shown_.trialsSettings; }
  /// Samples of a generation that was stopped, of how many; {0, 0} where there is none.
  [[nodiscard]] std::array<std::size_t, 2> stoppedAt() const;
  [[nodiscard]] const StageLog& stages() const { return stages_; }
  [[nodiscard]] JobRunner& runner() { return runner_; }
  /// Writes files while other jobs run.
  [[nodiscard]] JobRunner& writer() { return writer_; }

signals:
  void samplesChanged();
  void fitChanged();
  void sweepChanged();
  void trialsChanged();
  void problem(const QString& sentence);
  /// What is worth knowing and no problem.
  void note(const QString& sentence);
  /// Samples of a file are those that are shown now, new ones or some that were here before.
  void samplesOpened(const QString& file);
  /// These files now contain samples or a network.
  void saved(const std::vector<std::filesystem::path>& files);
  /// Work begins that needs hundreds of megabytes.
  void memoryNeeded();

private:
  /// Reports that samples are being made, and returns true, where they are: nothing else starts then.
  bool waitsForSamples();
  /// What the job has finished, drained by the window.
  struct Rows {
    std::mutex mutex;
    std::vector<SweepPoint> points;
    std::vector<DecoderTrial> trials;
  };
  void drain();
  /// Shows a network, and keeps it.
  void take(const std::shared_ptr<NetworkFit>& fit, const QString& slide);
  /// The oldest without a name leave the list where it is full.
  void forgetOldest();
  /// Takes a network off the list, and its files at the next saving.
  void dropKept(std::size_t kept);
  /// Shows other results, and keeps those that were shown while there is room.
  void show(NetworkResults results);
  void showOpened(NetworkResults results);
  void forgetOldestPast();

  JobRunner runner_;
  JobRunner writer_{JobRunner::Orders::Each};
  SensorDesign design_;
  NetworkResults shown_;
  std::deque<NetworkResults> past_;              ///< of other designs and samples, the newest first
  std::shared_ptr<SampleGeneration> generation_; ///< written by the job alone while it runs
  std::shared_ptr<Rows> rows_;
  StageLog stages_;
  bool openingResults_ = false;
  QString lastSlide_; ///< the movement that the newest network of the list follows
};

} // namespace palp
