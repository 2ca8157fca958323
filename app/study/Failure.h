#pragma once

#include <exception>
#include <filesystem>
#include <string>

namespace palp {

/// The file and why it cannot be reached: a folder that lets nobody in, links in a circle.
std::string fileFailureInWords(const std::filesystem::filesystem_error& failure);

/// The message of an exception, for the last catch at the root of a thread: the text of an Error as it is; of others
/// that they are a mistake of the program.
std::string failureInWords(const std::exception_ptr& failure);

} // namespace palp
