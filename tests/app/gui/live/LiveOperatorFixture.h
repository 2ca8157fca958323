#pragma once

#include "io/board/RecordingReader.h"
#include "tests/app/gui/live/LivePageFixture.h"

#include <QMessageBox>
#include <QTemporaryDir>

namespace palp {

/// Presses a button of the next question.
inline void answerQuestion(QMessageBox::StandardButton button) {
  auto* timer = new QTimer(qApp);
  QObject::connect(timer, &QTimer::timeout, timer, [timer, button] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box == nullptr) return;
    timer->stop();
    timer->deleteLater();
    QTest::mouseClick(box->button(button), Qt::LeftButton);
  });
  timer->start(20);
}

inline std::vector<std::string> marksOf(const QString& file) {
  RecordingReader reader(file.toStdString());
  std::vector<std::string> marks;
  while (const auto entry = reader.next())
    if (entry->kind == RecordingEntry::Kind::Mark) marks.emplace_back(entry->bytes.begin(), entry->bytes.end());
  return marks;
}

/// What an operator does in the first half hour, by real clicks and keys.
class LiveOperator : public Live {
protected:
  void recordTo(const QString& file) { find<QLineEdit>("recordFile").setText(file); }
  bool startsToRecord() {
    click("record");
    return wait([&] { return page.host().status().recording; });
  }
  bool stopsToRecord() {
    click("record");
    return wait([&] { return !page.host().status().recording; });
  }
  bool isRed(const char* label) {
    auto& words = find<QLabel>(label);
    return wait([&] { return words.isVisible() && words.property("role") == "problem" && !words.text().isEmpty(); });
  }
  bool records(const QString& file, std::uint64_t frames) {
    recordTo(file);
    return startsToRecord() && waitForFrames(frames) && stopsToRecord();
  }
  bool plays(const QString& file) {
    use([&](LiveSettings& live) {
      live.source = LiveSourceKind::Recording;
      live.recording = file.toStdString();
    });
    return wait([&] { return page.host().replaying() && page.host().history().last() != nullptr; });
  }

  QTemporaryDir folder;
};

} // namespace palp
