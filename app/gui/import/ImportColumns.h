#pragma once

#include "io/ImportDraft.h"

#include <QTableView>

#include <memory>
#include <vector>

namespace palp {

struct OpenedTables;

/// The first rows of measured tables. Above them each column has its meaning, which is chosen from a list; of several
/// columns whose heads are marked all get it.
class ImportColumns : public QTableView {
  Q_OBJECT

public:
  explicit ImportColumns(QWidget* parent = nullptr);

  /// Emits nothing.
  void display(const std::shared_ptr<const OpenedTables>& tables, const ImportDraft& draft);
  /// Marks the columns of an array and shows them.
  void markColumns(int first, int count);

signals:
  /// By the user's hand only.
  void assigned(const std::vector<palp::ColumnPlace>& columns, palp::ColumnMeaning meaning);

protected:
  /// A click on the meaning of a marked column keeps the others marked.
  [[nodiscard]] QItemSelectionModel::SelectionFlags selectionCommand(const QModelIndex& index,
                                                                     const QEvent* event) const override;

private:
  class Model;
  void assign(int column, ColumnMeaning meaning);

  Model* model_;
};

} // namespace palp
