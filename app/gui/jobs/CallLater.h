#pragma once

#include <QMetaObject>
#include <QObject>

#include <utility>

#ifdef PALP_THREAD_SANITIZER
#include <sanitizer/tsan_interface.h>
#endif

namespace palp {

#ifdef PALP_THREAD_SANITIZER
/// Where a work of this type is handed over: Qt's queue is not compiled with the thread sanitizer, which would see a
/// race between the thread that queues and the one that calls.
template <class Work> inline char handover = 0;
#endif

/// Calls work() in the receiver's thread, after what waits there already; not at all where the receiver has gone by
/// then. From any thread.
template <class Work> void callLater(QObject& receiver, Work work) {
#ifdef PALP_THREAD_SANITIZER
  __tsan_release(&handover<Work>);
#endif
  QMetaObject::invokeMethod(
      &receiver,
      [work = std::move(work)] {
#ifdef PALP_THREAD_SANITIZER
        __tsan_acquire(&handover<Work>);
#endif
        work();
      },
      Qt::QueuedConnection);
}

} // namespace palp
