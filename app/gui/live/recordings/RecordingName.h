#pragma once

#include <QDateTime>

#include <filesystem>

namespace palp {

/// The file that is written where this one was wanted: itself while there is none of its name, else its name with the
/// date and time, with a number where that exists too.
std::filesystem::path freeFile(const std::filesystem::path& wanted, const QDateTime& now);
/// The same of a recording, which has an extension.
std::filesystem::path freeRecording(std::filesystem::path wanted, const QDateTime& now);

} // namespace palp
