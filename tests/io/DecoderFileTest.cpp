#include "io/DecoderFile.h"

#include "model/base/Error.h"
#include "nn/RbfTrainer.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

Decoder smallDecoder() {
  const Eigen::MatrixXd samples = Eigen::MatrixXd::Random(6, 20), forces = Eigen::MatrixXd::Random(3, 20);
  Decoder decoder;
  const RbfFit fit = trainRbf(samples, forces);
  decoder.model = fit.network;
  decoder.report = fit.report;
  decoder.input = {InputKind::Resistance, {4}, 10, 6, samples.rowwise().minCoeff(), samples.rowwise().maxCoeff()};
  decoder.designFingerprint = "0123456789abcdef";
  decoder.trainedWith = "palp train --seed 1";
  decoder.areaCount = 6;
  decoder.low_N = forces.rowwise().minCoeff();
  decoder.high_N = forces.rowwise().maxCoeff();
  decoder.residual_N = Eigen::MatrixXd::Ones(3, 6);
  return decoder;
}

std::string refusal(const std::string& text) {
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
  const Decoder decoder = smallDecoder();
  const Decoder again = parseNetwork(networkText(decoder), "net.json");
  const auto& a = std::get<RbfNetwork>(decoder.model);
  const auto& b = std::get<RbfNetwork>(again.model);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.centers, b.centers);
  EXPECT_EQ(a.tail, b.tail);
  EXPECT_EQ(a.spread, b.spread);
  EXPECT_EQ(a.form, b.form);
  EXPECT_EQ(networkText(decoder), networkText(again));
}

TEST(NetworkFile, KeepsTheRotationOfWhitenedInputs) {
  const Eigen::MatrixXd samples = Eigen::MatrixXd::Random(6, 20).array() + 100;
  RbfOptions options;
  options.scaling = Scaling::Whiten;
  options.relativeInputNoise = 5e-3; // about the samples' own variation: some components are left out
  options.spread = 1;
  Decoder decoder = smallDecoder();
  decoder.model = trainRbf(samples, Eigen::MatrixXd::Random(3, 20), options).network;
  const Decoder again = parseNetwork(networkText(decoder), "net.json");
  EXPECT_EQ(std::get<RbfNetwork>(again.model).predict(samples), std::get<RbfNetwork>(decoder.model).predict(samples));
  EXPECT_NE(
      refusal(replaced(networkText(decoder), "\"rotation\":{\"rows\":", "\"rotation\":{\"rows\":1")).find("rotation"),
      std::string::npos);
}

TEST(NetworkFile, RefusesWhatItDoesNotKnow) {
  const std::string text = networkText(smallDecoder());
  EXPECT_NE(refusal(replaced(text, "\"mode\"", "\"moed\"")).find("moed"), std::string::npos);
  EXPECT_NE(refusal(replaced(text, "\"palp_network\":1", "\"palp_network\":2")).find("newer"), std::string::npos);
  EXPECT_NE(refusal(replaced(text, "\"rbf\"", "\"svm\"")).find("svm"), std::string::npos);
}

TEST(NetworkFile, RefusesWrongTypesAndSizesWithTheKey) {
  const std::string text = networkText(smallDecoder());
  EXPECT_NE(refusal(replaced(text, "\"area_count\":6", "\"area_count\":\"six\"")).find("area_count"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(text, "\"values_per_row\":6", "\"values_per_row\":7")).find("input.low"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(text, "\"spread_convention\":\"radbas\"", "\"spread_convention\":\"fwhm\"")).find("fwhm"),
            std::string::npos);
}

TEST(NetworkFile, RefusesEveryTruncation) {
  const std::string text = networkText(smallDecoder());
  for (std::size_t length = 0; length + 2 < text.size(); length += 97) {
    const std::string sentence = refusal(text.substr(0, length));
    EXPECT_EQ(sentence.rfind("net.json", 0), 0U) << length;
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
  }
}

} // namespace
} // namespace palp
