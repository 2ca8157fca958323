#include "model/base/Cancelled.h"

#include "model/base/Error.h"

#include <gtest/gtest.h>

#include <type_traits>

namespace palp {
namespace {

TEST(Cancelled, IsThrownWhereItWasAskedToStopAndOnlyThere) {
  std::stop_source source;
  EXPECT_NO_THROW(throwIfStopped({}));
  EXPECT_NO_THROW(throwIfStopped(source.get_token()));
  source.request_stop();
  EXPECT_THROW(throwIfStopped(source.get_token()), Cancelled);
}

/// What refuses bad input catches palp::Error; a cancel must pass it by.
TEST(Cancelled, IsNoErrorAndIsCaughtWithAllExceptions) {
  static_assert(!std::is_base_of_v<Error, Cancelled>);
  static_assert(!std::is_base_of_v<std::runtime_error, Cancelled>);
  try {
    throw Cancelled();
  } catch (const std::exception& caught) {
    EXPECT_STREQ(caught.what(), "cancelled");
  }
}

} // namespace
} // namespace palp
