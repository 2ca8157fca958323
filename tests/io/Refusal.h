#pragma once

#include "model/base/Error.h"

#include <string>
#include <utility>

namespace palp {

/// The sentence with which the work refuses; empty where it does not.
template <class Work> std::string refusal(Work&& work) {
  try {
    std::forward<Work>(work)();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

} // namespace palp
