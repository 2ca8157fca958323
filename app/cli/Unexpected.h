#pragma once

#include <string>

namespace CLI {
class App;
} // namespace CLI

namespace palp {

/// What a command line has that `command` does not know, with the nearest word that it does know:
/// "'--chek' is not expected here; did you mean --check?".
std::string unexpectedInWords(const CLI::App& command);

} // namespace palp
