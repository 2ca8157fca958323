#pragma once

#include "app/gui/jobs/NetworkSession.h"

#include <QStringList>

#include <memory>

namespace palp {

/// Which samples, network and list are saved in files: identifies them without keeping them in memory.
class ResultsMark {
public:
  void set(const NetworkResults& results) {
    samples_ = results.samples;
    fit_ = results.fit;
    list_ = results.listed();
  }
  [[nodiscard]] bool is(const NetworkResults& results) const {
    return same(samples_, results.samples) && same(fit_, results.fit) && list_ == results.listed();
  }

private:
  /// A deleted one differs from all existing ones.
  template <class T> static bool same(const std::weak_ptr<T>& one, const std::shared_ptr<T>& other) {
    return !one.owner_before(other) && !other.owner_before(one);
  }

  std::weak_ptr<const NetworkSamples> samples_;
  std::weak_ptr<const NetworkFit> fit_;
  QStringList list_;
};

} // namespace palp
