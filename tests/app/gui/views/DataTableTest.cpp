#include "app/gui/views/DataTable.h"

#include <QHeaderView>
#include <QTest>

#include <gtest/gtest.h>

namespace palp {
namespace {

const QStringList kHeads{"name", "error"};
const std::vector<QStringList> kRows{{"b", "10"}, {"c", "9.5"}, {"a", "-"}};

class SortedTable : public testing::Test {
protected:
  SortedTable() {
    table.show(kHeads, kRows);
    table.QWidget::show();
  }
  void clickHead(int column) {
    QHeaderView& heads = *table.horizontalHeader();
    const QPoint at(heads.sectionViewportPosition(column) + heads.sectionSize(column) / 2, heads.height() / 2);
    QTest::mouseClick(heads.viewport(), Qt::LeftButton, {}, at);
  }
  QStringList names() {
    QStringList all;
    for (int row = 0; row < table.rowCount(); ++row) all << table.item(row, 0)->text();
    return all;
  }
  DataTable table{"table.csv"};
};

TEST_F(SortedTable, AClickOnAHeadSortsByNumbersAndAThirdOneTakesTheOldOrder) {
  clickHead(1);
  EXPECT_EQ(names(), QStringList({"c", "b", "a"})) << "9.5 before 10, words behind";
  clickHead(1);
  EXPECT_EQ(names(), QStringList({"a", "b", "c"}));
  clickHead(1);
  EXPECT_EQ(names(), QStringList({"b", "c", "a"}));
  clickHead(0);
  EXPECT_EQ(names(), QStringList({"a", "b", "c"}));
}

TEST_F(SortedTable, RowsKeepWhatTheyAreAndNewOnesAreSortedToo) {
  clickHead(0);
  EXPECT_EQ(table.dataRow(0), 2);
  EXPECT_EQ(table.shownRow(0), 1);
  EXPECT_EQ(table.dataRow(-1), -1);
  EXPECT_EQ(table.shownRow(-1), -1);
  table.mark(1);
  EXPECT_TRUE(table.item(2, 0)->font().bold()) << "the row of show()";
  table.show(kHeads, {{"z", "1"}, {"y", "2"}});
  EXPECT_EQ(names(), QStringList({"y", "z"}));
  EXPECT_EQ(table.csv(), "name,error\nz,1\ny,2\n") << "in the order of show()";
}

} // namespace
} // namespace palp
