#include "app/cli/Command.h"

#include "model/base/GotExpected.h"

#include <CLI/CLI.hpp>

namespace palp {

namespace {

/// An empty value is a variable of a script that was not set; taken as if the option were not there, it would hide
/// that.
CLI::Option* notEmpty(CLI::Option* option) {
  return option->check(
      [](const std::string& value) {
        return value.empty() ? gotExpected("''", "a value that is not empty") : std::string();
      },
      "");
}

} // namespace

Option Option::required() {
  option_->required();
  return *this;
}

Option Option::needs(Option other) {
  option_->needs(other.option_);
  return *this;
}

Option Option::excludes(Option other) {
  option_->excludes(other.option_);
  return *this;
}

Option Option::oneOf(const std::vector<std::string>& allowed) {
  option_->check(CLI::IsMember(allowed));
  return *this;
}

Option Option::byDefault(const std::string& value) {
  option_->default_val(value);
  return *this;
}

Option Option::oneValueEach() {
  option_->allow_extra_args(false);
  return *this;
}

Option Command::flag(const std::string& names, bool& value, const std::string& what) {
  return Option(app_->add_flag(names, value, what));
}

void Command::group(const std::string& heading) {
  app_->option_defaults()->group(heading);
}

Option Command::option(const std::string& names, std::string& value, const char* type, const std::string& what) {
  return Option(notEmpty(app_->add_option(names, value, what))->type_name(type));
}

Option Command::option(const std::string& names, std::filesystem::path& value, const char* type,
                       const std::string& what) {
  return Option(notEmpty(app_->add_option(names, value, what))->type_name(type));
}

Option Command::option(const std::string& names, std::vector<std::string>& values, const char* type,
                       const std::string& what) {
  return Option(notEmpty(app_->add_option(names, values, what))->type_name(type));
}

void Command::rest(std::vector<std::string>& words) {
  app_->allow_extras();
  app_->callback([app = app_, &words] { words = app->remaining(); });
}

} // namespace palp
