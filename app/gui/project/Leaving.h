#pragma once

#include <QPointer>
#include <QString>
#include <QStringList>

#include <functional>
#include <utility>
#include <vector>

class QWidget;

namespace palp {

struct Project;

/// A way of leaving what is open.
struct Leaving {
  enum class Way {
    Quit,         ///< the program ends
    OtherProject, ///< another project takes the place of this one
    Edit          ///< the same project with other settings
  };
  Way way = Way::Quit;
  const Project* next = nullptr; ///< what is open afterwards; null where the program ends
};

/// The one question that every way of leaving asks: what would end or be lost? Whoever records, computes or holds
/// something answers it for its part.
class LossQuestion {
public:
  /// A sentence for each thing that would end or be lost.
  using Answer = std::function<QStringList(const Leaving& leaving)>;

  /// Asks `answer` from now on, as long as `owner` lives.
  void ask(QObject& owner, Answer answer) { answers_.emplace_back(&owner, std::move(answer)); }
  [[nodiscard]] QStringList losses(const Leaving& leaving) const;

private:
  std::vector<std::pair<QPointer<QObject>, Answer>> answers_;
};

/// True where there are no losses, or the user accepts them.
bool acceptsLosses(const QStringList& losses, QWidget* parent = nullptr);

} // namespace palp
