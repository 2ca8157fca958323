#include "app/gui/jobs/samples/ResultFiles.h"

#include "app/gui/jobs/samples/SampleFiles.h"
#include "app/gui/network/words/SamplesWords.h"
#include "io/AtomicFile.h"
#include "io/DecoderFile.h"
#include "model/base/Error.h"
#include "tests/app/gui/FullDisk.h"
#include "tests/app/gui/WindowFixture.h"

#include <QTemporaryDir>

#include <limits>
#include <map>

namespace palp {
namespace {

namespace fs = std::filesystem;

/// Ways in which a file is broken; none: it is not there.
const std::map<std::string, std::function<void(const fs::path&)>> kTwins{
    {"truncated",
     [](const fs::path& file) {
       const std::string text = readFile(file);
       writeFile(file, text.substr(0, text.size() * 2 / 3), true);
     }},
    {"empty", [](const fs::path& file) { writeFile(file, "", true); }},
    {"random", [](const fs::path& file) { writeFile(file, std::string("\x7f\0\xff\x01 not ours", 14), true); }},
    {"newer",
     [](const fs::path& file) {
       std::string text = readFile(file);
       text.insert(text.find_first_of("0123456789", text.find("palp_")), "99"); // of its version
       writeFile(file, text, true);
     }},
    {"folder",
     [](const fs::path& file) {
       fs::remove(file);
       fs::create_directory(file);
     }},
};

/// A folder with samples of the paper's design and two networks.
class ResultFilesTest : public testing::Test {
protected:
  static void SetUpTestSuite() {
    const Project project = quickProject();
    NetworkSession session;
    session.setDesign(project.design);
    session.generate(project.samples, project.mesh);
    ASSERT_TRUE(QTest::qWaitFor([&] { return session.samples() != nullptr; }, kPatience_ms));
    for (const double spread : {2.0, 3.0}) {
      NetworkSettings settings = project.network;
      settings.automaticSpread = false;
      settings.chosenSpread = spread;
      session.train(settings);
      ASSERT_TRUE(QTest::qWaitFor(
          [&] { return session.fit() != nullptr && session.fit()->settings.chosenSpread == spread; }, kPatience_ms));
    }
    NetworkSettings swept = project.network;
    swept.sweepCount = 3;
    session.sweep(swept);
    ASSERT_TRUE(QTest::qWaitFor([&] { return session.sweepPoints().size() == 3 && !session.working(); }, kPatience_ms));
    made_ = session.results();
    DecoderTrial trained, refused;
    trained.kind = DecoderKind::Polynomial2;
    trained.error = session.fit()->error.error;
    trained.error.eq13Percent(1) = std::numeric_limits<double>::infinity(); // of a force that is 0 somewhere
    trained.place = PlaceError{{1.5, 2.5}, 0.25, {}};
    trained.spread = 1.25;
    trained.seconds = 0.5;
    trained.microsecondsPerSample = 3;
    refused.kind = DecoderKind::TouchInversion;
    refused.refusal = "it needs touches";
    made_.trials = {trained, refused};
    made_.trialsSettings = project.network;
    made_.trialsSettings.noise = 0.001;
  }
  static void TearDownTestSuite() { made_ = {}; }

  ResultFilesTest() { saveResults(folder(), made_, {}); }
  [[nodiscard]] fs::path folder() const { return (temporary_.path() + "/p.palp").toStdString(); }
  [[nodiscard]] OpenedResults opened() const { return openResults(folder(), made_.design, {}); }
  /// The decoder's file of a kept network.
  [[nodiscard]] fs::path keptFile(std::size_t kept) const {
    return folder() / "networks" /
           (made_.kept[kept]->made.toString("yyyyMMdd-HHmmss-zzz").toStdString() + ".network.json");
  }
  /// All files below the folder and what they hold.
  [[nodiscard]] std::map<fs::path, std::string> content() const {
    std::map<fs::path, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(folder()))
      if (entry.is_regular_file()) all[entry.path()] = readFile(entry.path());
    return all;
  }
  /// What was made, with fewer samples.
  static NetworkResults others() {
    NetworkResults results = made_;
    auto samples = std::make_shared<NetworkSamples>(*made_.samples);
    samples->training = areaPart(samples->training, 0);
    samples->test = areaPart(samples->test, 1);
    results.samples = samples;
    results.fit = made_.kept.back();
    return results;
  }
  static bool holds(const std::map<fs::path, std::string>& files, const std::string& content) {
    return std::any_of(files.begin(), files.end(), [&](const auto& file) { return file.second == content; });
  }

  static NetworkResults made_;

private:
  QTemporaryDir temporary_;
};

NetworkResults ResultFilesTest::made_;

TEST_F(ResultFilesTest, AnUnreadableNetworkLeavesTheOthersOpenAndStaysItself) {
  for (const auto& [how, breakFile] : kTwins) {
    SCOPED_TRACE(how);
    saveResults(folder(), made_, resultFiles(folder()));
    breakFile(keptFile(1));
    const auto before = content();
    OpenedResults found = opened();
    ASSERT_EQ(found.problems.size(), 1U);
    EXPECT_NE(found.problems[0].find(keptFile(1).filename().string()), std::string::npos) << found.problems[0];
    EXPECT_EQ(found.problems[0].find('\n'), std::string::npos);
    ASSERT_NE(found.results.samples, nullptr);
    ASSERT_NE(found.results.fit, nullptr);
    EXPECT_EQ(found.results.kept.size(), 1U);
    saveResults(folder(), others(), found.opened);
    const auto after = content();
    EXPECT_TRUE(after.contains(keptFile(0)));
    EXPECT_TRUE(fs::exists(keptFile(1)));
    if (before.contains(keptFile(1))) {
      EXPECT_EQ(after.at(keptFile(1)), before.at(keptFile(1)));
    }
    fs::remove_all(keptFile(1));
  }
}

TEST_F(ResultFilesTest, ANetworkWhoseSettingsCannotBeReadIsListedAsFarAsItSaysThemItself) {
  const fs::path settings = keptFile(0).parent_path() / (keptFile(0).stem().stem().string() + ".settings.json");
  ASSERT_TRUE(fs::exists(settings));
  writeFile(settings, "{", true);
  const OpenedResults found = opened();
  EXPECT_EQ(found.problems.size(), 1U);
  ASSERT_EQ(found.results.kept.size(), 2U);
  EXPECT_EQ(found.results.kept[0]->settings.chosenSpread, made_.kept[0]->settings.chosenSpread);
}

TEST_F(ResultFilesTest, NoFileThatCannotBeOpenedIsOverwritten) {
  for (const char* name : {"samples.csv", "samples-test.csv", "network.json", "sweeps.json"})
    for (const auto& [how, breakFile] : kTwins) {
      SCOPED_TRACE(std::string(name) + " " + how);
      fs::remove_all(folder());
      saveResults(folder(), made_, {});
      breakFile(folder() / name);
      const bool isFolder = fs::is_directory(folder() / name);
      const std::string broken = isFolder ? "" : readFile(folder() / name);
      const OpenedResults found = opened();
      ASSERT_EQ(found.problems.size(), 1U);
      EXPECT_NE(found.problems[0].find(name), std::string::npos) << found.problems[0];
      EXPECT_EQ(found.results.samples == nullptr, std::string(name) == "samples.csv");
      if (isFolder) { // in whose place nothing can be written
        EXPECT_THROW(saveResults(folder(), others(), found.opened), Error);
        continue;
      }
      const auto said = saveResults(folder(), others(), found.opened);
      ASSERT_FALSE(said.empty());
      EXPECT_NE(said[0].find("is kept as"), std::string::npos) << said[0];
      EXPECT_TRUE(holds(content(), broken));
      EXPECT_EQ(opened().problems, std::vector<std::string>{}) << "what was saved is whole";
      EXPECT_EQ(opened().results.samples->training.forces_N, others().samples->training.forces_N);
      EXPECT_TRUE(saveResults(folder(), made_, resultFiles(folder())).empty()) << "and is this window's now";
    }
}

TEST_F(ResultFilesTest, SweepAndComparisonComeBackAsTheyWere) {
  const NetworkResults& found = opened().results;
  EXPECT_EQ(found.sweepSettings, made_.sweepSettings);
  EXPECT_EQ(found.trialsSettings, made_.trialsSettings);
  ASSERT_EQ(found.sweep.size(), made_.sweep.size());
  for (std::size_t k = 0; k < found.sweep.size(); ++k) {
    const SweepPoint &is = found.sweep[k], &was = made_.sweep[k];
    EXPECT_EQ(is.spread, was.spread);
    EXPECT_EQ(is.error.eq13Percent, was.error.eq13Percent);
    EXPECT_EQ(is.error.rmsePercentOfRange, was.error.rmsePercentOfRange);
    EXPECT_EQ(is.report.leaveOneOut, was.report.leaveOneOut);
    EXPECT_EQ(is.report.condition, was.report.condition);
    EXPECT_EQ(is.report.seconds, was.report.seconds);
  }
  ASSERT_EQ(found.trials.size(), 2U);
  EXPECT_EQ(found.trials[0].kind, DecoderKind::Polynomial2);
  EXPECT_EQ(found.trials[0].error.eq13Percent, made_.trials[0].error.eq13Percent) << "infinity, too";
  EXPECT_EQ(found.trials[0].place->rms_mm, made_.trials[0].place->rms_mm);
  EXPECT_EQ(found.trials[0].place->median_mm, 0.25);
  EXPECT_EQ(found.trials[0].spread, 1.25);
  EXPECT_EQ(found.trials[1].refusal, "it needs touches");
  EXPECT_EQ(found.listed(), made_.listed()) << "nothing is left to be saved";
}

TEST_F(ResultFilesTest, ASweepOfOtherSamplesIsNotShownWithThese) {
  const std::string swept = readFile(folder() / "sweeps.json");
  saveResults(folder(), others(), resultFiles(folder()));
  writeFile(folder() / "sweeps.json", swept, true);
  const OpenedResults found = opened();
  ASSERT_EQ(found.problems.size(), 1U);
  EXPECT_NE(found.problems[0].find("belong to other samples"), std::string::npos) << found.problems[0];
  EXPECT_TRUE(found.results.sweep.empty());
  EXPECT_TRUE(found.results.trials.empty());
  NetworkResults without = made_;
  without.sweep.clear();
  without.trials.clear();
  saveResults(folder(), without, resultFiles(folder()));
  EXPECT_FALSE(fs::exists(folder() / "sweeps.json")) << "none is there any more";
}

TEST_F(ResultFilesTest, ATableOfSomebodyElseIsNamedByWhatItBeginsWith) {
  const fs::path table = folder() / "sweep.csv", empty = folder() / "empty.csv";
  writeFile(table, "# design {\"palp_design\": 1}\nspread,Fx RMSE [% of range]\n1,2\n", true);
  writeFile(empty, "", true);
  const auto refusal = [&](const fs::path& file) -> std::string {
    try {
      openSampleFiles({file}, made_.design, {});
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(refusal(table).find("sweep.csv: not a Palp sample file (it starts with \"spread,Fx RMSE"),
            std::string::npos)
      << refusal(table);
  EXPECT_NE(refusal(empty).find("is not a Palp file (empty)"), std::string::npos) << refusal(empty);
  EXPECT_NE(refusal(folder() / "network.json").find("is a network, not samples"), std::string::npos)
      << refusal(folder() / "network.json");
}

TEST_F(ResultFilesTest, FilesOfAnotherWindowAreKeptUnlessTheyHoldTheSame) {
  EXPECT_TRUE(saveResults(folder(), made_, {}).empty()) << "the same bytes";
  const auto before = content();
  EXPECT_EQ(saveResults(folder(), others(), {}).size(), 4U);
  const auto after = content();
  for (const auto& [file, bytes] : before) EXPECT_TRUE(holds(after, bytes)) << file;
}

TEST_F(ResultFilesTest, OnlyANetworkThatWasTakenAwayLeavesTheFolder) {
  NetworkResults results = made_;
  results.kept.clear(); // of another design, or never read
  saveResults(folder(), results, resultFiles(folder()));
  EXPECT_EQ(opened().results.kept.size(), 2U);
  results.removed = {made_.kept[1]->made};
  saveResults(folder(), results, resultFiles(folder()));
  ASSERT_EQ(opened().results.kept.size(), 1U);
  EXPECT_EQ(opened().results.kept[0]->made, made_.kept[0]->made);
}

TEST_F(ResultFilesTest, NetworksOfAnotherDesignStayAndAreNotListed) {
  Decoder other = made_.kept[1]->decoder;
  other.designFingerprint = "0123456789abcdef";
  writeNetwork(other, keptFile(1));
  const OpenedResults found = opened();
  EXPECT_EQ(found.ofOtherDesigns, 1);
  EXPECT_TRUE(found.problems.empty());
  EXPECT_EQ(found.results.kept.size(), 1U);
  saveResults(folder(), found.results, found.opened);
  EXPECT_TRUE(fs::exists(keptFile(1)));
}

TEST_F(ResultFilesTest, OnAFullDiskOneLineSaysSoAndTheOldFilesAreWhole) {
  const auto before = content();
  const auto size = [&](const char* name) { return fs::file_size(folder() / name); };
  // Full before the first file is done, then before the second, then before the networks.
  for (const auto bytes : {size("samples-test.csv") / 2, size("samples-test.csv") - 1, size("network.json") / 2}) {
    SCOPED_TRACE(bytes);
    NetworkResults results = made_;
    auto kept = std::make_shared<NetworkFit>(*made_.fit);
    kept->made = kept->made.addMSecs(1);
    results.kept.insert(results.kept.begin(), kept);
    std::string said;
    {
      const FullDisk full(bytes);
      try {
        saveResults(folder(), results, resultFiles(folder()));
      } catch (const Error& error) {
        said = error.what();
      }
    }
    EXPECT_NE(said.find("cannot be written"), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos) << said;
    EXPECT_EQ(said.find(".new"), std::string::npos) << "the name of the file that was asked for: " << said;
    const auto after = content();
    for (const auto& [file, bytesBefore] : before) EXPECT_EQ(after.at(file), bytesBefore) << file;
    for (const auto& [file, any] : after) EXPECT_NE(file.filename().string()[0], '.') << file;
  }
}

TEST_F(ResultFilesTest, SamplesSplitForATestOpenAgain) {
  const fs::path alone = folder() / "alone.csv";
  fs::copy_file(folder() / "samples.csv", alone);
  NetworkResults results;
  results.design = made_.design;
  results.samples = std::make_shared<const NetworkSamples>(openSampleFiles({alone}, made_.design, {}));
  EXPECT_EQ(results.samples->test.size(), 6) << "one of the six on each area";
  const fs::path other = folder().parent_path() / "other.palp";
  saveResults(other, results, {});
  const OpenedResults found = openResults(other, made_.design, {});
  EXPECT_EQ(found.problems, std::vector<std::string>{});
  ASSERT_NE(found.results.samples, nullptr);
  EXPECT_EQ(found.results.samples->training.forces_N, results.samples->training.forces_N);
  EXPECT_EQ(found.results.samples->test.forces_N, results.samples->test.forces_N);
}

TEST_F(ResultFilesTest, ManySamplesOfOneDesignDoNotPushOutThoseOfAnother) {
  const Project project = quickProject();
  NetworkSession session;
  session.setDesign(project.design);
  session.openSamples({folder() / "samples.csv"});
  ASSERT_TRUE(QTest::qWaitFor([&] { return session.samples() != nullptr && !session.working(); }, kPatience_ms));
  const NetworkSamples* first = session.samples();
  SensorDesign thicker = project.design;
  thicker.block_mm.z() += 1;
  session.setDesign(thicker);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SampleSettings samples = project.samples;
    samples.seed = 10 + seed;
    const NetworkSamples* before = session.samples();
    session.generate(samples, project.mesh);
    ASSERT_TRUE(QTest::qWaitFor([&] { return session.samples() != before && !session.working(); }, kPatience_ms));
  }
  session.setDesign(project.design);
  EXPECT_EQ(session.samples(), first) << "undoing the design brings them back";
}

TEST_F(ResultFilesTest, SamplesThatWereHereBeforeBringBackWhatWasMadeOfThem) {
  const Project project = quickProject();
  NetworkSession session;
  session.setDesign(project.design);
  const fs::path file = folder() / "samples.csv";
  const auto opens = [&](const fs::path& name) {
    const NetworkSamples* before = session.samples();
    session.openSamples({name});
    ASSERT_TRUE(QTest::qWaitFor([&] { return session.samples() != before && !session.working(); }, kPatience_ms));
  };
  opens(file);
  EXPECT_EQ(session.fit(), nullptr) << "nothing was made of them here";
  session.train(project.network);
  ASSERT_TRUE(QTest::qWaitFor([&] { return session.fit() != nullptr && !session.working(); }, kPatience_ms));
  NetworkSettings swept = project.network;
  swept.sweepCount = 3;
  session.sweep(swept);
  ASSERT_TRUE(QTest::qWaitFor([&] { return session.sweepPoints().size() == 3 && !session.working(); }, kPatience_ms));
  const NetworkFit* trained = session.fit();

  SampleSettings others = project.samples;
  others.seed = 77;
  const NetworkSamples* first = session.samples();
  session.generate(others, project.mesh);
  ASSERT_TRUE(QTest::qWaitFor([&] { return session.samples() != first && !session.working(); }, kPatience_ms));
  EXPECT_EQ(session.fit(), nullptr);
  session.train(project.network);
  ASSERT_TRUE(QTest::qWaitFor([&] { return session.fit() != nullptr && !session.working(); }, kPatience_ms));
  QString said;
  QObject::connect(&session, &NetworkSession::note, [&](const QString& sentence) { said = sentence; });
  const fs::path copy = folder() / "copy.csv";
  fs::copy_file(file, copy);
  fs::copy_file(testFileOf(file), testFileOf(copy));
  opens(copy);
  EXPECT_EQ(session.fit(), trained);
  EXPECT_TRUE(session.fitIsCurrent());
  EXPECT_EQ(session.sweepPoints().size(), 3u);
  EXPECT_EQ(session.kept().size(), 2u) << "the list has both";
  EXPECT_TRUE(said.contains("were loaded earlier")) << said.toStdString();
  EXPECT_TRUE(samplesWords(session).contains("from copy.csv")) << samplesWords(session).toStdString();

  const NetworkSamples* shown = session.samples();
  SensorDesign thicker = project.design;
  thicker.block_mm.z() += 1;
  session.setDesign(thicker);
  EXPECT_FALSE(session.upToDate());
  session.setDesign(project.design);
  EXPECT_EQ(session.samples(), shown) << "those that were shown, not others of the design";
  EXPECT_TRUE(session.upToDate());
  EXPECT_EQ(session.kept().size(), 2u);
}

} // namespace
} // namespace palp
