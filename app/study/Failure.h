#pragma once

#include <exception>
#include <string>

namespace palp {

/// What an exception says, for the last catch at the root of a thread: the text of an Error as it is; of the file
/// system's the file and the reason; of others that they are a mistake of the program.
std::string failureInWords(const std::exception_ptr& failure);

} // namespace palp
