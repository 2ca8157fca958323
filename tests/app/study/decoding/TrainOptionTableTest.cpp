#include "app/study/decoding/TrainOptionTable.h"

#include "app/study/decoding/DecoderTraining.h"
#include "io/DecoderFile.h"
#include "model/base/Text.h"
#include "tests/app/study/decoding/AnotherValue.h"
#include "tests/app/study/decoding/PrintDecoderKind.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace palp {

namespace {

/// The options of a command as printed, read by the table.
TrainOptions parsed(const std::string& command) {
  TrainOptions options;
  std::istringstream words(command);
  for (std::string name, value; words >> name >> value;)
    for (const TrainOption& option : trainOptionTable())
      if (name == "--" + option.name && !option.set(options, value)) ADD_FAILURE() << command;
  return options;
}

/// Forty samples of two areas whose resistances follow the force.
SampleSet fortySamples() {
  SampleSet set;
  const SensorDesign design = paperDesign();
  set.rowWires = design.rowWires();
  set.electrodesPerRowWire = design.electrodesPerRowWire();
  set.columnWires = design.columnWires();
  set.areaCount = 2;
  set.area = Eigen::VectorXi::LinSpaced(40, 0, 39).unaryExpr([](int i) { return i % 2; });
  set.forces_N = Eigen::MatrixXd::NullaryExpr(3, 40, [](Eigen::Index c, Eigen::Index i) {
    return std::sin(1.7 * static_cast<double>(i) * static_cast<double>(c + 1) + static_cast<double>(c));
  });
  const auto answer = [&](Eigen::Index k, Eigen::Index i) {
    const Eigen::Vector3d mixing(std::sin(0.3 * static_cast<double>(k)), std::cos(0.7 * static_cast<double>(k)),
                                 1 + set.area(i) * std::sin(static_cast<double>(k)));
    const double linear = mixing.dot(set.forces_N.col(i));
    return linear + 0.05 * linear * linear;
  };
  set.displacements_mm = Eigen::MatrixXd::NullaryExpr(3 * set.rowWires * set.electrodesPerRowWire, 40,
                                                      [&](auto k, auto i) { return 0.01 * answer(k, i); });
  set.resistances_ohm = Eigen::MatrixXd::NullaryExpr(set.rowWires * set.columnWires, 40,
                                                     [&](auto k, auto i) { return 1000 + answer(k, i); });
  return set;
}

/// The network file without the command that it was trained with and the time that it took.
std::string trainedBytes(const SampleSet& set, const TrainOptions& options) {
  const SensorDesign design = paperDesign();
  Decoder decoder = trainDecoder(set, &design, options);
  decoder.trainedWith.clear();
  decoder.report.seconds = 0;
  decoder.seed = 0;
  return networkText(decoder);
}

class OptionsOf : public testing::TestWithParam<DecoderKind> {};

} // namespace

TEST(TrainOptionTable, HasWordsLimitsAndNamesForEachOption) {
  std::set<std::string> names, keys;
  for (const TrainOption& option : trainOptionTable()) {
    EXPECT_TRUE(names.insert(option.name).second) << option.name;
    EXPECT_TRUE(option.key.empty() || keys.insert(option.key).second) << option.key;
    EXPECT_FALSE(option.label.empty() || option.help.empty()) << option.name;
    EXPECT_EQ(option.allowed.empty(), option.form == TrainOption::Form::Text) << option.name;
  }
}

TEST(TrainOptionTable, SetsWhatItAllowsAndRefusesTheRestUnchanged) {
  for (const TrainOption& option : trainOptionTable()) {
    TrainOptions options;
    EXPECT_FALSE(option.isSet(options)) << option.name;
    ASSERT_TRUE(option.set(options, anotherValue(option))) << option.name;
    EXPECT_TRUE(option.isSet(options)) << option.name;
    EXPECT_EQ(option.text(options), anotherValue(option));
    if (option.form == TrainOption::Form::Text) continue;
    const TrainOptions before = options;
    for (const char* wrong : {"nonsense", "-1", "nan", "inf", "1e200", "1,5"}) {
      if (std::string(wrong) == "1e200" && option.high > 1e200) continue;
      EXPECT_FALSE(option.set(options, wrong)) << option.name << " " << wrong;
    }
    EXPECT_EQ(options, before) << option.name;
  }
}

TEST(TrainOptionTable, IsReadBackFromTheCommand) {
  TrainOptions all;
  for (const TrainOption& option : trainOptionTable()) {
    TrainOptions one;
    option.set(one, anotherValue(option));
    option.set(all, anotherValue(option));
    EXPECT_EQ(parsed(asCommand(one)), one) << asCommand(one);
  }
  EXPECT_EQ(parsed(asCommand(all)), all) << asCommand(all);
}

TEST(DecoderTraits, HasOneRowForEachKind) {
  std::set<std::string> names;
  for (std::size_t k = 0; k < kDecoderTraits.size(); ++k) {
    EXPECT_EQ(traits(static_cast<DecoderKind>(k)).kind, static_cast<DecoderKind>(k));
    EXPECT_TRUE(names.insert(kDecoderTraits[k].name).second) << kDecoderTraits[k].name;
  }
  EXPECT_EQ(namesOfDecodersWith(&DecoderTraits::canBeCalibrated), "rbf, ml or touch");
}

/// Disabled fields and refusals follow `applies`: it is true exactly where the option changes the trained decoder.
TEST_P(OptionsOf, ApplyWhereTheyChangeTheDecoder) {
  const SampleSet set = fortySamples();
  TrainOptions usual;
  usual.input = InputKind::Resistance;
  usual.rows = "4";
  usual.noise = 1e-4;
  usual.centers = 10;
  usual.decoder = GetParam();
  const std::string bytes = trainedBytes(set, usual);
  TrainOptions others = usual;
  for (const TrainOption& option : trainOptionTable())
    if (option.inForm && !option.applies(GetParam())) option.set(others, anotherValue(option));
  EXPECT_TRUE(trainedBytes(set, others) == bytes) << "an option that does not apply changes the decoder";
  for (const TrainOption& option : trainOptionTable()) {
    if (!option.inForm || !option.applies(GetParam())) continue;
    TrainOptions one = usual;
    if (option.name == "forgetting") one.solver = LeastSquaresMethod::Recursive;
    const std::string without = trainedBytes(set, one);
    const std::vector<std::string> values = option.choices.empty() ? std::vector{anotherValue(option)} : option.choices;
    EXPECT_TRUE(std::any_of(values.begin(), values.end(),
                            [&](const std::string& value) {
                              option.set(one, value);
                              return trainedBytes(set, one) != without;
                            }))
        << option.name << " changes nothing";
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, OptionsOf, testing::ValuesIn(decodersWith(&DecoderTraits::ofAreas)),
                         [](const auto& one) {
                           std::string text = name(one.param);
                           std::erase(text, '-');
                           return text;
                         });

} // namespace palp
