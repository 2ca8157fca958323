#pragma once

#include "model/RowColumnResistance.h"
#include "model/SensorDesign.h"

#include <QTableView>

namespace palp {

class ElectrodeRows;

/// Every electrode of both layers, where it rests and how it moves; a range that is marked can be copied.
class ElectrodeTable : public QTableView {
public:
  explicit ElectrodeTable(QWidget* parent = nullptr);

  void show(const SensorDesign& design, const ElectrodeDisplacements& displacements);

protected:
  void keyPressEvent(QKeyEvent* event) override;

private:
  ElectrodeRows* rows_ = nullptr;
};

} // namespace palp
