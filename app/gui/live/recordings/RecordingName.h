#pragma once

#include <QDateTime>

#include <filesystem>

namespace palp {

/// The file that is recorded to where this one was wanted: itself while there is none of its name, else its name with
/// the date and time, counted on where that is there too.
std::filesystem::path freeRecording(std::filesystem::path wanted, const QDateTime& now);

} // namespace palp
