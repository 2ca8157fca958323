#pragma once

#include "app/study/decoding/TrainOptions.h"

#include <functional>
#include <string>
#include <vector>

namespace palp {

/// One option of training. The command line, the command that reproduces a decoder, project files, the window's form,
/// undo and the sentences about a network are loops over trainOptionTable(): an option is a member of TrainOptions, its
/// row in TrainOptionTable.cpp, and the code that uses it.
struct TrainOption {
  enum class Form { Text, Choice, Number, Share, WholeNumber };

  std::string name{};  ///< on the command line, without dashes: "centers-by"
  std::string key{};   ///< in project files: "centers_by"
  std::string label{}; ///< in forms and sentences: "choice of centres"
  std::string help{};  ///< what it does; of the command line and of the field's tooltip
  Form form = Form::Text;
  double low = 0, high = 0;           ///< of numbers, both included
  std::vector<std::string> choices{}; ///< of a choice
  std::string allowed{};              ///< in refusals
  std::string initial{};              ///< its text where it is not set; empty: follows from the mode
  bool alwaysInCommands = false;      ///< also where it has its initial value
  bool alwaysInFiles = false;         ///< the same of project files
  bool inForm = true;                 ///< the window's form has its field; otherwise a panel shows it in its own way
  std::function<bool(DecoderKind)> applies = [](DecoderKind) { return true; };
  std::function<std::string(const TrainOptions&)> text{};
  /// Returns false, and changes nothing, where the text is not an allowed value.
  std::function<bool(TrainOptions&, const std::string&)> set{};
  std::function<std::string(const RbfOptions&)> ofMode{}; ///< what the mode makes of it; may be empty

  [[nodiscard]] bool isSet(const TrainOptions& options) const { return text(options) != initial; }
};

/// All options, in the order of commands. Spread and centres have no key: project files keep the numbers of their
/// fields also where these are not in use.
const std::vector<TrainOption>& trainOptionTable();

} // namespace palp
