#include "io/DecoderFile.h"

#include "model/base/Error.h"
#include "nn/RbfTrainer.h"
#include "tests/io/SmallDecoders.h"

#include <SourceDir.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <limits>
#include <set>

namespace palp {
namespace {

std::string networkRefusal(const std::string& text) {
  try {
    static_cast<void>(parseNetwork(text, "net.json"));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(NetworkFile, ReadsBackToTheSameBits) {
  std::vector<DecoderKind> kinds = decodersWith(&DecoderTraits::ofAreas);
  kinds.push_back(DecoderKind::TouchInversion);
  for (const DecoderKind kind : kinds) {
    const std::string text = networkText(smallDecoder(kind));
    EXPECT_EQ(networkText(parseNetwork(text, "net.json")), text) << name(kind);
  }
  const std::string together = networkText(togetherDecoder());
  EXPECT_EQ(networkText(parseNetwork(together, "net.json")), together);
  const Decoder decoder = smallDecoder(DecoderKind::Rbf);
  const Decoder again = parseNetwork(networkText(decoder), "net.json");
  const auto& a = std::get<RbfNetwork>(decoder.model);
  const auto& b = std::get<RbfNetwork>(again.model);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.centers, b.centers);
  EXPECT_EQ(a.tail, b.tail);
  EXPECT_EQ(a.spread, b.spread);
  EXPECT_EQ(a.form, b.form);
}

TEST(NetworkFile, OfAFileWhoseNameIsNotUtf8IsWrittenAllTheSame) {
  Decoder decoder = smallDecoder(DecoderKind::Linear);
  decoder.trainedWith = "palp train m\xe4rz.csv";
  EXPECT_EQ(parseNetwork(networkText(decoder), "net.json").trainedWith, "palp train m\xef\xbf\xbdrz.csv");
}

TEST(NetworkFile, WithANumberThatIsNotFiniteIsNotWritten) {
  Decoder decoder = smallDecoder(DecoderKind::Linear);
  decoder.report.condition = std::numeric_limits<double>::infinity(); // may be: it is written as null and read back
  EXPECT_EQ(parseNetwork(networkText(decoder), "net.json").report.condition, decoder.report.condition);
  decoder.report.leaveOneOut = Eigen::VectorXd::Constant(3, std::numeric_limits<double>::quiet_NaN());
  try {
    static_cast<void>(networkText(decoder));
    ADD_FAILURE() << "written, and no reader takes it";
  } catch (const Error& refused) {
    EXPECT_NE(std::string(refused.what()).find("fit.leave_one_out_N is nan"), std::string::npos) << refused.what();
  }
}

TEST(NetworkFile, KeepsATouchTableInEitherForm) {
  Decoder decoder = smallDecoder(DecoderKind::TouchInversion);
  auto& model = std::get<KernelForwardModel>(decoder.model);
  const auto readBack = [&](const std::string& text) {
    return std::get<KernelForwardModel>(parseNetwork(text, "net.json").model).table.coefficients;
  };
  model.table.coefficients(0, 0) = -2e4; // large ones and negative ones, too
  const std::string packed = networkText(decoder);
  EXPECT_NE(packed.find("\"packed\":\""), std::string::npos);
  EXPECT_EQ(packed.find("\"coefficients\""), std::string::npos);
  ASSERT_GT(model.table.coefficients.maxCoeff(), 0.01);
  EXPECT_EQ(readBack(packed), model.table.coefficients);
  model.table.coefficients /= 3; // no whole parts: as files before 1.0.0 have them
  const std::string plain = networkText(decoder);
  EXPECT_EQ(plain.find("\"packed\""), std::string::npos);
  EXPECT_EQ(readBack(plain), model.table.coefficients);
  EXPECT_GT(plain.size(), packed.size());
}

TEST(NetworkFile, RefusesAPackedTableThatIsDamaged) {
  const std::string text = networkText(smallDecoder(DecoderKind::TouchInversion));
  const std::string before = "\"packed\":\"";
  const std::size_t begin = text.find(before) + before.size(), end = text.find('"', begin);
  ASSERT_LT(begin + 400, end);
  const auto with = [&](const std::string& packed) {
    return networkRefusal(text.substr(0, begin) + packed + text.substr(end));
  };
  const std::string whole = text.substr(begin, end - begin);
  EXPECT_EQ(with(whole), "");
  EXPECT_NE(with("%" + whole.substr(1)).find("model.table.packed"), std::string::npos);
  EXPECT_NE(with(whole.substr(0, whole.size() / 8 * 4)).find("damaged"), std::string::npos);
  EXPECT_NE(with("").find("as many numbers as the table has"), std::string::npos);
  std::string flipped = whole;
  flipped[whole.size() / 2] = whole[whole.size() / 2] == 'A' ? 'B' : 'A';
  EXPECT_NE(with(flipped).find("damaged"), std::string::npos);
  // Numbers enough to fill the memory are not even tried.
  const std::string nodes = "\"nodes\":";
  const std::size_t first = text.find(nodes), last = text.find(']', first);
  EXPECT_NE(networkRefusal(text.substr(0, first) + nodes + "[1000,1000" + text.substr(last))
                .find("as many numbers as the table has"),
            std::string::npos);
}

TEST(NetworkFile, KeepsTheCorrectionOfATouchDecoder) {
  Decoder decoder = smallDecoder(DecoderKind::TouchInversion);
  decoder.correction = OutputCorrection{Eigen::MatrixXd::Random(5, 5), Eigen::VectorXd::Random(5)};
  const std::string text = networkText(decoder);
  const Decoder again = parseNetwork(text, "net.json");
  ASSERT_TRUE(again.correction);
  EXPECT_EQ(again.correction->gains, decoder.correction->gains);
  EXPECT_EQ(again.correction->offset, decoder.correction->offset);
  decoder.correction->offset.conservativeResize(4);
  EXPECT_NE(networkRefusal(networkText(decoder)).find("offset"), std::string::npos);
  decoder.correction->offset.conservativeResize(5);
  decoder.correction->gains.conservativeResize(4, 5);
  EXPECT_NE(networkRefusal(networkText(decoder)).find("gains"), std::string::npos);
  Decoder other = smallDecoder(DecoderKind::Linear);
  other.correction = again.correction;
  EXPECT_NE(networkRefusal(networkText(other)).find("correction"), std::string::npos);
}

TEST(NetworkFile, KeepsTheRotationOfWhitenedInputs) {
  const Decoder decoder = whitenedDecoder();
  const Eigen::MatrixXd samples = SmallSamples().inputs;
  ASSERT_LT(std::get<RbfNetwork>(decoder.model).scaler.dimensions(), 3);
  const Decoder again = parseNetwork(networkText(decoder), "net.json");
  EXPECT_EQ(std::get<RbfNetwork>(again.model).predict(samples), std::get<RbfNetwork>(decoder.model).predict(samples));
  EXPECT_NE(networkRefusal(replaced(networkText(decoder), "\"rotation\":{\"rows\":", "\"rotation\":{\"rows\":1"))
                .find("rotation"),
            std::string::npos);
}

TEST(NetworkFile, RefusesWhatItDoesNotKnow) {
  const std::string text = networkText(smallDecoder(DecoderKind::Rbf));
  EXPECT_NE(networkRefusal(replaced(text, "\"mode\"", "\"moed\"")).find("moed"), std::string::npos);
  EXPECT_NE(networkRefusal("{\"hello\": 1}").find("not a network file of Palp"), std::string::npos);
  EXPECT_NE(networkRefusal(replaced(text, "\"palp_network\":1", "\"palp_network\":2")).find("newer"),
            std::string::npos);
  EXPECT_NE(networkRefusal(replaced(text, "\"rbf\"", "\"svm\"")).find("svm"), std::string::npos);
}

TEST(NetworkFile, RefusesWrongTypesAndSizesWithTheKey) {
  const std::string text = networkText(smallDecoder(DecoderKind::Rbf));
  EXPECT_NE(networkRefusal(replaced(text, "\"area_count\":2", "\"area_count\":\"two\"")).find("area_count"),
            std::string::npos);
  EXPECT_NE(networkRefusal(replaced(text, "\"values_per_row\":3", "\"values_per_row\":4")).find("input.low"),
            std::string::npos);
  EXPECT_NE(
      networkRefusal(replaced(text, "\"spread_convention\":\"radbas\"", "\"spread_convention\":\"fwhm\"")).find("fwhm"),
      std::string::npos);
}

/// Why the file of a decoder is refused after a change; empty where it is not.
std::string refusalWith(Decoder decoder, const std::function<void(Decoder&)>& change) {
  EXPECT_EQ(networkRefusal(networkText(decoder)), "");
  change(decoder);
  return networkRefusal(networkText(decoder));
}

TEST(NetworkFile, RefusesAreasThatTheDesignDoesNotHave) {
  const Decoder rbf = smallDecoder(DecoderKind::Rbf), likelihood = smallDecoder(DecoderKind::MaximumLikelihood);
  for (const Decoder& decoder : {rbf, likelihood})
    for (const int area : {-1, 2, 1000000})
      EXPECT_NE(refusalWith(decoder, [&](Decoder& d) { d.areaOfClass[1] = area; }).find("area_of_class"),
                std::string::npos)
          << area;
  EXPECT_NE(refusalWith(rbf, [](Decoder& d) { d.areaOfClass.pop_back(); }).find("area_of_class"), std::string::npos);
  EXPECT_NE(refusalWith(rbf, [](Decoder& d) { d.areas.reset(); }).find("area_of_class"), std::string::npos);
  EXPECT_NE(refusalWith(rbf, [](Decoder& d) { d.areaCount = 0; }).find("area_count: got 0"), std::string::npos);
  const std::string sentence = refusalWith(togetherDecoder(), [&](Decoder& d) {
    d.areas = rbf.areas;
    d.areaOfClass = {0, 1};
  });
  EXPECT_NE(sentence.find("areas"), std::string::npos) << sentence;
}

TEST(NetworkFile, RefusesOutputsThatAreNoForces) {
  const auto twoOutputs = [](Decoder& d) {
    auto& model = std::get<PolynomialRidge>(d.model);
    model.weights.conservativeResize(2, Eigen::NoChange);
    model.bias.conservativeResize(2);
    d.low_N.conservativeResize(2);
    d.high_N.conservativeResize(2);
    d.residual_N.conservativeResize(2, Eigen::NoChange);
  };
  const std::string sentence = refusalWith(smallDecoder(DecoderKind::Polynomial2), twoOutputs);
  EXPECT_NE(sentence.find("3 outputs, the components of one force instead of 2"), std::string::npos) << sentence;
  const std::string several = refusalWith(togetherDecoder(), [](Decoder& d) { d.areaCount = 3; });
  EXPECT_NE(several.find("9 outputs, three per area instead of 6"), std::string::npos) << several;
}

/// The product with a model's matrix takes what the rotation gives, not what goes into it.
TEST(NetworkFile, RefusesModelsThatDoNotFitTheirScalersRotation) {
  const auto rotate = [](Decoder& d) {
    const Eigen::MatrixXd rotation = Eigen::MatrixXd::Ones(1, 3);
    if (auto* polynomial = std::get_if<PolynomialRidge>(&d.model)) polynomial->scaler.rotation = rotation;
    if (auto* network = std::get_if<BackPropagationNetwork>(&d.model)) network->inputScaler.rotation = rotation;
  };
  for (const DecoderKind kind : {DecoderKind::Linear, DecoderKind::Polynomial2, DecoderKind::BackPropagation})
    EXPECT_NE(refusalWith(smallDecoder(kind), rotate)
                  .find("1 " + std::string(kind == DecoderKind::Polynomial2 ? "rows" : "columns") +
                        ", one per scaled input instead of 3"),
              std::string::npos)
        << name(kind);
  const auto rotateOutputs = [](Decoder& d) {
    std::get<BackPropagationNetwork>(d.model).outputScaler.rotation = Eigen::MatrixXd::Identity(3, 3);
  };
  EXPECT_NE(refusalWith(smallDecoder(DecoderKind::BackPropagation), rotateOutputs).find("without rotation"),
            std::string::npos);
}

TEST(NetworkFile, RefusesAnInputWithoutRows) {
  const std::string sentence = refusalWith(smallDecoder(DecoderKind::Rbf), [](Decoder& d) { d.input.rows.clear(); });
  EXPECT_NE(sentence.find("input.rows: got [], expected one row-wire or more"), std::string::npos) << sentence;
}

TEST(NetworkFile, RefusesToInvertEq1OfADesignUnderTheField) {
  const std::string sentence = refusalWith(smallDecoder(DecoderKind::TwoStepGaussNewton), [](Decoder& d) {
    std::get<TwoStep>(d.model).design->resistance = FieldLaw{};
  });
  EXPECT_NE(sentence.find("the inversion of Eq. (1): not available under the field law"), std::string::npos)
      << sentence;
}

TEST(NetworkFile, KeepsAFirstStepThatInvertsTheField) {
  const SmallSamples samples;
  const Decoder decoder = fieldTwoStepDecoder();
  const std::string text = networkText(decoder);
  const Decoder again = parseNetwork(text, "net.json");
  EXPECT_EQ(networkText(again), text);
  EXPECT_EQ(std::get<TwoStep>(again.model).block->displacements_mm(samples.inputs),
            std::get<TwoStep>(decoder.model).block->displacements_mm(samples.inputs));
  // A network of Eq. (1) knows nothing of it: its bytes are as ever.
  EXPECT_EQ(networkText(smallDecoder(DecoderKind::TwoStepGaussNewton)).find("\"block\""), std::string::npos);
}

TEST(NetworkFile, RefusesAFirstStepThatCannotInvertTheField) {
  const auto refused = [](const std::function<void(TwoStep&)>& change) {
    return refusalWith(fieldTwoStepDecoder(), [&](Decoder& d) { change(std::get<TwoStep>(d.model)); });
  };
  EXPECT_NE(refused([](TwoStep& t) { t.block->rest_ohm(1) = 0; }).find("rest_ohm"), std::string::npos);
  EXPECT_NE(refused([](TwoStep& t) { t.block->forces_N.conservativeResize(3, 2); }).find("forces_N"),
            std::string::npos);
  EXPECT_NE(refused([](TwoStep& t) { t.block->modes_mm_per_N.conservativeResize(3, 2); }).find("modes_mm_per_N"),
            std::string::npos);
  EXPECT_NE(refused([](TwoStep& t) { t.block->modes_mm_per_N.conservativeResize(2, 3); }).find("force"),
            std::string::npos);
  EXPECT_NE(refused([](TwoStep& t) { t.design = squareDesign(); }).find("one of network, design and block"),
            std::string::npos);
  EXPECT_NE(refused([](TwoStep& t) { t.block.reset(); }).find("one of network, design and block"), std::string::npos);
}

TEST(NetworkFile, RefusesWholeNumbersThatAreNoInt) {
  const std::string text = networkText(smallDecoder(DecoderKind::Rbf));
  for (const char* number : {"1e300", "-1e300", "9223372036854775808", "2147483648", "2.5"})
    EXPECT_NE(networkRefusal(replaced(text, "\"area_count\":2", "\"area_count\":" + std::string(number)))
                  .find("whole number"),
              std::string::npos)
        << number;
}

TEST(NetworkFile, TheFuzzersSeedsAreNetworksOfAllKinds) {
  std::set<DecoderKind> kinds;
  for (const auto& file : std::filesystem::directory_iterator(PALP_SOURCE_DIR "/tests/fuzz/networks"))
    kinds.insert(readNetwork(file.path()).kind);
  EXPECT_EQ(kinds.size(), decodersWith(&DecoderTraits::ofAreas).size());
}

TEST(NetworkFile, RefusesEveryTruncation) {
  const std::string text = networkText(smallDecoder(DecoderKind::Rbf));
  for (std::size_t length = 0; length + 2 < text.size(); length += 97) {
    const std::string sentence = networkRefusal(text.substr(0, length));
    EXPECT_EQ(sentence.rfind("net.json", 0), 0U) << length;
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
  }
}

} // namespace
} // namespace palp
