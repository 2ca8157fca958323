#include "app/gui/import/ImportColumns.h"

#include "app/gui/import/OpenedTables.h"

#include <QAbstractTableModel>
#include <QApplication>
#include <QComboBox>
#include <QHeaderView>
#include <QPainter>
#include <QStyledItemDelegate>
#include <QTimer>

#include <algorithm>

namespace palp {

namespace {

constexpr int kColumnWidth_px = 118;

QString text(const std::string& words) {
  return QString::fromStdString(words);
}

/// Draws the first row as drop-down lists, and opens one where it is clicked on.
class MeaningDelegate : public QStyledItemDelegate {
public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    if (index.row() != 0) return QStyledItemDelegate::paint(painter, option, index);
    QStyleOptionComboBox box;
    box.rect = option.rect.adjusted(1, 1, -1, -1);
    box.palette = option.palette;
    box.fontMetrics = option.fontMetrics;
    box.state = option.state | QStyle::State_Enabled;
    box.currentText = index.data().toString();
    if (option.state.testFlag(QStyle::State_Selected)) painter->fillRect(option.rect, option.palette.highlight());
    const QStyle* style = option.widget->style();
    style->drawComplexControl(QStyle::CC_ComboBox, &box, painter, option.widget);
    style->drawControl(QStyle::CE_ComboBoxLabel, &box, painter, option.widget);
  }

  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& /*option*/,
                        const QModelIndex& index) const override {
    auto* box = new QComboBox(parent);
    box->setObjectName("columnMeaning");
    box->setAccessibleName(index.model()->headerData(index.column(), Qt::Horizontal).toString());
    for (const auto& [meaning, name] : kColumnMeanings.all()) box->addItem(QString(name), static_cast<int>(meaning));
    auto* self = const_cast<MeaningDelegate*>(this);
    connect(box, &QComboBox::activated, self, [self, box] {
      emit self->commitData(box);
      emit self->closeEditor(box);
    });
    QTimer::singleShot(0, box, &QComboBox::showPopup);
    return box;
  }
  void setEditorData(QWidget* editor, const QModelIndex& index) const override {
    auto* box = static_cast<QComboBox*>(editor);
    box->setCurrentIndex(box->findData(index.data(Qt::EditRole)));
  }
  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override {
    const QVariant chosen = static_cast<QComboBox*>(editor)->currentData();
    if (chosen != index.data(Qt::EditRole)) model->setData(index, chosen);
  }
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    return QStyledItemDelegate::sizeHint(option, index) + QSize(0, index.row() == 0 ? 8 : 0);
  }
};

} // namespace

/// One row with the meanings, then the rows of the tables; the columns of all tables next to each other.
class ImportColumns::Model : public QAbstractTableModel {
public:
  explicit Model(ImportColumns* view) : QAbstractTableModel(view), view_(*view) {}

  void show(const std::shared_ptr<const OpenedTables>& tables, const ImportDraft& draft) {
    const bool others = tables != tables_;
    if (others) beginResetModel();
    tables_ = tables;
    draft_ = draft;
    places_.clear();
    rows_ = 0;
    for (std::size_t t = 0; tables_ && t < tables_->tables.size(); ++t) {
      for (std::size_t c = 0; c < tables_->tables[t].columns.size(); ++c) places_.push_back({t, c});
      rows_ = std::max(rows_, static_cast<int>(tables_->tables[t].rows.size()));
    }
    if (others) return endResetModel();
    emit dataChanged(index(0, 0), index(rowCount() - 1, columnCount() - 1));
  }

  [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override { return parent.isValid() ? 0 : rows_ + 1; }
  [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override {
    return parent.isValid() ? 0 : static_cast<int>(places_.size());
  }
  [[nodiscard]] ColumnPlace place(int column) const { return places_[static_cast<std::size_t>(column)]; }

  [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override {
    const ColumnPlace at = place(index.column());
    const ColumnMeaning meaning = draft_.meaning(at);
    if (index.row() == 0) {
      if (role == Qt::EditRole) return static_cast<int>(meaning);
      if (role == Qt::ToolTipRole)
        return tr("What this column is. Mark several heads (drag, or Shift and a click) to choose it for all of them; "
                  "forces chosen together are added up.");
      return role == Qt::DisplayRole ? shown(meaning) : QVariant();
    }
    if (role == Qt::ForegroundRole && meaning == ColumnMeaning::LeftOut)
      return view_.palette().brush(QPalette::Disabled, QPalette::Text);
    if (role == Qt::TextAlignmentRole) return static_cast<int>(Qt::AlignRight | Qt::AlignVCenter);
    if (role != Qt::DisplayRole) return {};
    const auto& rows = tables_->tables[at.table].rows;
    const auto row = static_cast<std::size_t>(index.row()) - 1;
    return row < rows.size() ? text(rows[row][at.column]) : QString();
  }

  bool setData(const QModelIndex& index, const QVariant& value, int /*role*/) override {
    view_.assign(index.column(), static_cast<ColumnMeaning>(value.toInt()));
    return true;
  }

  [[nodiscard]] Qt::ItemFlags flags(const QModelIndex& index) const override {
    return QAbstractTableModel::flags(index) | (index.row() == 0 ? Qt::ItemIsEditable : Qt::NoItemFlags);
  }

  [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override {
    if (orientation == Qt::Vertical)
      return role == Qt::DisplayRole ? (section == 0 ? tr("Meaning") : QString::number(section)) : QVariant();
    if (role != Qt::DisplayRole && role != Qt::ToolTipRole) return {};
    const ColumnPlace at = place(section);
    const TablePreview& table = tables_->tables[at.table];
    const TablePreview::Column& column = table.columns[at.column];
    QString head = column.name.empty() ? tr("Column %1").arg(at.column + 1) : text(column.name);
    if (!column.unit.empty() && !head.contains(text(column.unit))) head += QString(" [%1]").arg(text(column.unit));
    const QString file = text(table.file.filename().string());
    if (role == Qt::ToolTipRole) return tr("%1, column %2 of %3").arg(head).arg(at.column + 1).arg(file);
    return tables_->tables.size() > 1 ? head + "\n" + file : head;
  }

private:
  /// "Fx", or "Fx (sum)" of several columns.
  [[nodiscard]] QString shown(ColumnMeaning meaning) const {
    const QString name = text(kColumnMeanings.name(meaning));
    if (meaning != ColumnMeaning::Fx && meaning != ColumnMeaning::Fy && meaning != ColumnMeaning::Fz) return name;
    const auto count =
        std::count_if(places_.begin(), places_.end(), [&](ColumnPlace at) { return draft_.meaning(at) == meaning; });
    return count > 1 ? tr("%1 (sum)").arg(name) : name;
  }

  ImportColumns& view_;
  std::shared_ptr<const OpenedTables> tables_;
  ImportDraft draft_;
  std::vector<ColumnPlace> places_;
  int rows_ = 0;
};

ImportColumns::ImportColumns(QWidget* parent) : QTableView(parent), model_(new Model(this)) {
  setObjectName("importColumns");
  setAccessibleName(tr("First rows of the table, with the meaning of each column"));
  setModel(model_);
  setItemDelegate(new MeaningDelegate(this));
  setSelectionBehavior(QAbstractItemView::SelectColumns);
  setSelectionMode(QAbstractItemView::ExtendedSelection);
  setEditTriggers(QAbstractItemView::EditKeyPressed | QAbstractItemView::AnyKeyPressed);
  connect(this, &QAbstractItemView::clicked, this, [this](const QModelIndex& index) {
    if (index.row() == 0) edit(index);
  });
  setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  setWordWrap(false);
  horizontalHeader()->setDefaultSectionSize(kColumnWidth_px);
  horizontalHeader()->setTextElideMode(Qt::ElideMiddle);
  horizontalHeader()->setHighlightSections(false);
  verticalHeader()->setDefaultSectionSize(fontMetrics().lineSpacing() + 4);
}

void ImportColumns::display(const std::shared_ptr<const OpenedTables>& tables, const ImportDraft& draft) {
  model_->show(tables, draft);
  setRowHeight(0, fontMetrics().lineSpacing() + 12);
}

void ImportColumns::markColumns(int first, int count) {
  selectionModel()->select({model_->index(0, first), model_->index(0, first + count - 1)},
                           QItemSelectionModel::ClearAndSelect | QItemSelectionModel::Columns);
  scrollTo(model_->index(0, first), QAbstractItemView::PositionAtCenter);
}

QItemSelectionModel::SelectionFlags ImportColumns::selectionCommand(const QModelIndex& index,
                                                                    const QEvent* event) const {
  if (event != nullptr && index.isValid() && index.row() == 0 && selectionModel()->isColumnSelected(index.column()))
    return QItemSelectionModel::NoUpdate;
  return QTableView::selectionCommand(index, event);
}

/// To all marked columns, where this one is among them.
void ImportColumns::assign(int column, ColumnMeaning meaning) {
  std::vector<ColumnPlace> columns{model_->place(column)};
  if (selectionModel()->isColumnSelected(column)) {
    columns.clear();
    for (const QModelIndex& marked : selectionModel()->selectedColumns())
      columns.push_back(model_->place(marked.column()));
  }
  std::sort(columns.begin(), columns.end());
  emit assigned(columns, meaning);
}

} // namespace palp
