#pragma once

#include "app/study/decoding/TrainOptionTable.h"
#include "model/base/Text.h"

namespace palp {

/// A value that the option allows and that is not the one that it has where it is not set.
inline std::string anotherValue(const TrainOption& option) {
  switch (option.form) {
  case TrainOption::Form::Text:
    return "1,4,7";
  case TrainOption::Form::Choice:
    return option.choices.back();
  case TrainOption::Form::Number:
  case TrainOption::Form::Share:
    return text(option.high > 1 ? 0.5 : option.high / 2);
  case TrainOption::Form::WholeNumber:
    return text(option.low + 7);
  }
  return {};
}

} // namespace palp
