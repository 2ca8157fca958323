#pragma once

#include "model/SensorDesign.h"

#include <QWidget>

class QComboBox;

namespace palp {

/// The law of the resistances and its read-out, to be switched next to their results; its numbers are in the Design
/// scene.
class LawBar : public QWidget {
  Q_OBJECT

public:
  explicit LawBar(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const SensorDesign& design);

signals:
  /// By the user's hand only, and only designs that can be built.
  void edited(const QString& what, const palp::SensorDesign& design);
  void refused(const QString& sentence);

private:
  QComboBox* add(const QString& key);

  SensorDesign design_;
  ResistanceLaw otherLaw_; ///< the numbers of the law that was shown before this one
  QComboBox* law_ = nullptr;
  QComboBox* readout_ = nullptr;
};

} // namespace palp
