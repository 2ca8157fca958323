#include "app/gui/touch/ElectrodeTable.h"

#include <QAbstractTableModel>
#include <QApplication>
#include <QClipboard>
#include <QHeaderView>
#include <QKeyEvent>

#include <utility>

namespace palp {

namespace {

constexpr int kRowGap_px = 6, kColumnGap_px = 16;

} // namespace

/// The cells' words are made where one looks: a board of 32 x 255 wires has thousands of rows.
class ElectrodeRows : public QAbstractTableModel {
public:
  using QAbstractTableModel::QAbstractTableModel;

  void set(const SensorDesign& design, const ElectrodeDisplacements& displacements) {
    layers_[0] = {tr("upper"), design.electrodesPerRowWire(), design.upperElectrodes_mm(), displacements.upper_mm};
    layers_[1] = {tr("lower"), design.electrodesPerColumnWire(), design.lowerElectrodes_mm(), displacements.lower_mm};
    if (!design.lowerFollowsRubber) {
      layers_[1].name = tr("lower, fixed");
      layers_[1].moved_mm.setZero();
    }
    const auto count = static_cast<int>(layers_[0].rest_mm.cols() + layers_[1].rest_mm.cols());
    if (count != std::exchange(count_, count)) {
      beginResetModel();
      endResetModel();
    } else if (count > 0) {
      emit dataChanged(index(0, 0), index(count - 1, kColumns - 1));
    }
  }

  [[nodiscard]] int rowCount(const QModelIndex& parent) const override { return parent.isValid() ? 0 : count_; }
  [[nodiscard]] int columnCount(const QModelIndex& parent) const override { return parent.isValid() ? 0 : kColumns; }

  [[nodiscard]] QVariant headerData(int section, Qt::Orientation way, int role) const override {
    if (role != Qt::DisplayRole || way != Qt::Horizontal) return {};
    const QStringList heads{tr("layer"),  tr("wire"),    tr("electrode"), tr("x [mm]"), tr("y [mm]"),
                            tr("z [mm]"), tr("ux [mm]"), tr("uy [mm]"),   tr("uz [mm]")};
    return heads.value(section);
  }

  [[nodiscard]] QVariant data(const QModelIndex& at, int role) const override {
    if (role == Qt::TextAlignmentRole && at.column() > 0) return QVariant(Qt::AlignRight | Qt::AlignVCenter);
    if (role != Qt::DisplayRole) return {};
    const auto upper = static_cast<int>(layers_[0].rest_mm.cols());
    const Layer& layer = layers_[at.row() < upper ? 0 : 1];
    const int place = at.row() < upper ? at.row() : at.row() - upper;
    const int column = at.column();
    if (column == 0) return layer.name;
    if (column == 1) return QString::number(place / layer.perWire);
    if (column == 2) return QString::number(place % layer.perWire);
    return column < 6 ? QString::number(layer.rest_mm(column - 3, place), 'g', 4)
                      : QString::number(layer.moved_mm(column - 6, place), 'g', 6);
  }

private:
  static constexpr int kColumns = 9;
  struct Layer {
    QString name;
    int perWire = 1;
    Eigen::Matrix3Xd rest_mm, moved_mm; ///< 3 x electrodes
  };
  std::array<Layer, 2> layers_;
  int count_ = 0;
};

ElectrodeTable::ElectrodeTable(QWidget* parent) : QTableView(parent), rows_(new ElectrodeRows(this)) {
  setObjectName("electrodeTable");
  setModel(rows_);
  setSelectionMode(QAbstractItemView::ContiguousSelection);
  setToolTip(tr("Position of each electrode at rest and its displacement; select cells and copy them with Ctrl+C"));
  verticalHeader()->hide();
  verticalHeader()->setDefaultSectionSize(fontMetrics().height() + kRowGap_px);
  verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
  QHeaderView& heads = *horizontalHeader();
  heads.setSectionResizeMode(QHeaderView::ResizeToContents);
  heads.setResizeContentsPrecision(0); // of the rows that are seen
  heads.setSectionResizeMode(0, QHeaderView::Interactive);
  heads.resizeSection(0, fontMetrics().horizontalAdvance(tr("lower, fixed")) + kColumnGap_px);
}

void ElectrodeTable::show(const SensorDesign& design, const ElectrodeDisplacements& displacements) {
  rows_->set(design, displacements);
}

void ElectrodeTable::keyPressEvent(QKeyEvent* event) {
  if (!event->matches(QKeySequence::Copy) || !selectionModel()->hasSelection()) return QTableView::keyPressEvent(event);
  const QItemSelectionRange range = selectionModel()->selection().front();
  QStringList lines;
  for (int row = range.top(); row <= range.bottom(); ++row) {
    QStringList cells;
    for (int column = range.left(); column <= range.right(); ++column)
      cells << rows_->index(row, column).data().toString();
    lines << cells.join('\t');
  }
  QApplication::clipboard()->setText(lines.join('\n') + "\n");
}

} // namespace palp
