#pragma once

#include <chrono>
#include <map>
#include <string>

namespace palp {

/// How often each stage of the work ran and how long it took; `stages` in every JSON result. Names: mesh, factorise,
/// solve, sample, train, predict, render.
class StageLog {
public:
  struct Count {
    int runs = 0;
    double seconds = 0;
  };

  void add(const std::string& stage, double seconds);
  void add(const StageLog& other);
  [[nodiscard]] const std::map<std::string, Count>& counts() const { return counts_; }
  [[nodiscard]] int runs(const std::string& stage) const;

  /// Runs the work and counts it, also where it throws; returns what the work returns.
  template <class Work> auto measure(const std::string& stage, Work&& work) {
    const struct Guard {
      StageLog& log;
      const std::string& name;
      std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
      ~Guard() { log.add(name, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()); }
    } guard{*this, stage};
    return work();
  }

private:
  std::map<std::string, Count> counts_;
};

} // namespace palp
