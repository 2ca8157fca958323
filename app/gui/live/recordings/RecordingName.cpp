#include "app/gui/live/recordings/RecordingName.h"

#include <QRegularExpression>

namespace palp {

std::filesystem::path freeRecording(std::filesystem::path wanted, const QDateTime& now) {
  if (!wanted.has_extension()) wanted += ".palprec";
  return freeFile(wanted, now);
}

std::filesystem::path freeFile(const std::filesystem::path& wanted, const QDateTime& now) {
  if (!std::filesystem::exists(wanted)) return wanted;
  static const QRegularExpression dated("-\\d{4}-\\d{2}-\\d{2}-\\d{6}(-\\d+)?$");
  QString stem = QString::fromStdString(wanted.stem().string()).remove(dated);
  stem += now.toString("-yyyy-MM-dd-HHmmss");
  const std::string extension = wanted.extension().string();
  std::filesystem::path free = wanted.parent_path() / (stem.toStdString() + extension);
  for (int number = 2; std::filesystem::exists(free); ++number)
    free = wanted.parent_path() / (stem.toStdString() + "-" + std::to_string(number) + extension);
  return free;
}

} // namespace palp
