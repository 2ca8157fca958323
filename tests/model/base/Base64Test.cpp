#include "model/base/Base64.h"

#include <gtest/gtest.h>

namespace palp {
namespace {

std::vector<unsigned char> bytesOf(std::string_view text) {
  return {text.begin(), text.end()};
}

TEST(Base64, WritesTheExamplesOfItsStandard) {
  EXPECT_EQ(base64(bytesOf("")), "");
  EXPECT_EQ(base64(bytesOf("f")), "Zg==");
  EXPECT_EQ(base64(bytesOf("fo")), "Zm8=");
  EXPECT_EQ(base64(bytesOf("foobar")), "Zm9vYmFy");
}

TEST(Base64, ReadsBackEveryByte) {
  std::vector<unsigned char> all;
  for (int i = 0; i < 256; ++i) all.push_back(static_cast<unsigned char>(i));
  for (std::size_t length = 253; length <= 256; ++length) {
    const std::vector<unsigned char> some(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(length));
    EXPECT_EQ(fromBase64(base64(some)), some);
  }
}

TEST(Base64, RefusesWhatIsNone) {
  for (const char* text : {"Zg=", "Zm9", "Z!==", "=AAA", "Zg==Zg=="}) EXPECT_FALSE(fromBase64(text)) << text;
}

} // namespace
} // namespace palp
