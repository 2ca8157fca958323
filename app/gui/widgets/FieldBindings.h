#pragma once

#include "app/gui/widgets/SpinBoxes.h"

#include <QCheckBox>
#include <QComboBox>
#include <QSignalBlocker>

#include <functional>
#include <type_traits>
#include <vector>

namespace palp {

/// Editors that are each bound to one member of a struct. display() shows the members and emits nothing; an edit by the
/// user changes the bound member alone and is reported under the name of the change.
template <class Settings> class FieldBindings {
public:
  using Edited = std::function<void(const QString& what, const Settings& next)>;

  explicit FieldBindings(Edited edited) : edited_(std::move(edited)) {}
  FieldBindings(const FieldBindings&) = delete; // the editors' connections refer to it
  FieldBindings& operator=(const FieldBindings&) = delete;

  [[nodiscard]] const Settings& settings() const { return settings_; }

  void display(const Settings& settings) {
    settings_ = settings;
    for (const auto& show : shows_) show();
  }

  /// Reports a change, unless it changes nothing.
  template <class Change> void edit(const QString& what, const Change& change) {
    Settings next = settings_;
    change(next);
    if (next == settings_) return;
    settings_ = next;
    edited_(what, next);
  }

  // `member` returns a reference to the member: a pointer to it, or a function of a Settings&. All return the editor.

  /// `factor`: what the box shows of the member's 1, as 100 for a share in percent.
  template <class Box, class Member>
  requires std::is_base_of_v<QDoubleSpinBox, Box> Box* bind(Box* box, const QString& what, Member member,
                                                            double factor = 1) {
    return add(
        box, &QDoubleSpinBox::valueChanged, what,
        [this, box, member, factor] { showExactly(*box, factor * std::invoke(member, settings_)); },
        [box, member, factor](Settings& settings, double /*value*/) {
          double& value = std::invoke(member, settings);
          value = readExactly(*box, value, factor);
        });
  }
  template <class Box, class Member>
  requires std::is_base_of_v<QSpinBox, Box> Box* bind(Box* box, const QString& what, Member member) {
    using Value = std::remove_reference_t<std::invoke_result_t<Member, Settings&>>;
    return add(
        box, &QSpinBox::valueChanged, what,
        [this, box, member] { box->setValue(static_cast<int>(std::invoke(member, settings_))); },
        [member](Settings& settings, int value) { std::invoke(member, settings) = static_cast<Value>(value); });
  }
  template <class Member> QCheckBox* bind(QCheckBox* box, const QString& what, Member member) {
    return add(
        box, &QCheckBox::toggled, what, [this, box, member] { box->setChecked(std::invoke(member, settings_)); },
        [member](Settings& settings, bool on) { std::invoke(member, settings) = on; });
  }
  /// The choices are the values of the member, an enumeration, from 0 on.
  template <class Member> QComboBox* bind(QComboBox* box, const QString& what, Member member) {
    using Value = std::remove_reference_t<std::invoke_result_t<Member, Settings&>>;
    return add(
        box, &QComboBox::currentIndexChanged, what,
        [this, box, member] { box->setCurrentIndex(static_cast<int>(std::invoke(member, settings_))); },
        [member](Settings& settings, int index) { std::invoke(member, settings) = static_cast<Value>(index); });
  }
  /// `show()` shows the member; `change(settings, value)` sets it to what `signal` passes.
  template <class Editor, class Signal, class Show, class Change>
  Editor* add(Editor* editor, Signal signal, const QString& what, Show show, Change change) {
    shows_.push_back([editor, show] {
      const QSignalBlocker quiet(editor);
      show();
    });
    QObject::connect(editor, signal, editor, [this, what, change](auto value) {
      edit(what, [&](Settings& settings) { change(settings, value); });
    });
    return editor;
  }

private:
  Edited edited_;
  Settings settings_;
  std::vector<std::function<void()>> shows_;
};

} // namespace palp
