#include "io/board/replay/ReplayCursor.h"

#include "io/board/Protocol.h"

#include <algorithm>

namespace palp {

ReplayCursor::ReplayCursor(const std::filesystem::path& path) : reader_(path) {
  here_.offset = reader_.place();
  here_.configuration = head().configuration;
}

RecordingEntry* ReplayCursor::report() {
  while (!read_) {
    if (!reader_.next(entry_)) return nullptr;
    entry_.hostTime_s = here_.clock.timeOf(entry_, head().info);
    read_ = entry_.kind == RecordingEntry::Kind::Raw;
    if (!read_) take();
  }
  return &entry_;
}

void ReplayCursor::pass() {
  if (report() == nullptr) return;
  read_ = false;
  ++here_.reports;
  here_.latest_s = std::max(here_.latest_s, entry_.hostTime_s);
  here_.offset = reader_.place();
}

void ReplayCursor::goTo(const ReplayPlace& place) {
  here_ = place;
  read_ = false;
  reader_.goTo(place.offset);
}

/// An entry between the reports.
void ReplayCursor::take() {
  if (entry_.kind == RecordingEntry::Kind::Mark) {
    here_.mark.assign(entry_.bytes.begin(), entry_.bytes.end());
    here_.markTime_s = entry_.hostTime_s;
    if (marks_ != nullptr) marks_->push_back({entry_.hostTime_s, here_.mark});
  }
  if (entry_.kind == RecordingEntry::Kind::Tare) {
    auto tare = decodeTare(entry_.bytes, head().info.rowWires, head().info.columnWires);
    here_.tare = tare ? std::make_shared<const Tare>(std::move(*tare)) : nullptr;
  }
  if (entry_.kind != RecordingEntry::Kind::Configuration) return;
  const auto decoded = decodeConfiguration(entry_.bytes);
  if (const auto* configuration = std::get_if<BoardConfiguration>(&decoded)) here_.configuration = *configuration;
}

} // namespace palp
