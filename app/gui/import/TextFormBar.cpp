#include "app/gui/import/TextFormBar.h"

#include "app/gui/widgets/MakeWidgets.h"
#include "app/gui/widgets/SpinBoxes.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QScopedValueRollback>

#include <string_view>

namespace palp {

namespace {

constexpr std::string_view kSeparatorLetters{"\0,;\t ", 5}, kDecimalLetters{"\0.,", 3}; ///< as the boxes list them
constexpr int kLastLine = 250;

QLabel* labelOf(const QString& words, QWidget* box) {
  auto* label = new QLabel(words);
  label->setBuddy(box);
  return label;
}

int placeOf(char letter, std::string_view letters) {
  return static_cast<int>(letters.find(letter));
}

} // namespace

TextFormBar::TextFormBar(QWidget* parent) : QWidget(parent) {
  separator_ =
      choiceBox("importSeparator", {tr("detected"), tr("comma"), tr("semicolon"), tr("tab"), tr("blanks and tabs")},
                tr("What separates the columns of the text"));
  decimal_ = choiceBox("importDecimal", {tr("detected"), tr("point"), tr("comma")}, tr("The decimal sign of the text"));
  namesLine_ = wholeBox("importNamesLine", {.low = -1, .high = kLastLine, .special = tr("detected")},
                        tr("Number of the line with the names of the columns; 0: the table has no names"));
  firstLine_ = wholeBox("importFirstLine", {.low = 0, .high = kLastLine, .special = tr("detected")},
                        tr("Number of the line with the first row"));
  tables_ = wholeBox("importTables", {.low = 1, .high = 1},
                     tr("How many of the tables belong to one recording, joined row by row or by their clocks; more "
                        "tables are further recordings"));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  addTo(*row, {labelOf(tr("Separator"), separator_), separator_, labelOf(tr("Decimal sign"), decimal_), decimal_,
               labelOf(tr("Names in line"), namesLine_), namesLine_, labelOf(tr("First row in line"), firstLine_),
               firstLine_, labelOf(tr("Tables per recording"), tables_), tables_, Part::stretch()});
  for (QComboBox* box : {separator_, decimal_}) connect(box, &QComboBox::currentIndexChanged, this, &TextFormBar::read);
  for (QSpinBox* box : {namesLine_, firstLine_, tables_})
    connect(box, &QSpinBox::valueChanged, this, &TextFormBar::read);
}

void TextFormBar::display(const TextForm& form, bool isText, int tablesOfOneRun, int files) {
  const QScopedValueRollback quiet(displaying_, true);
  separator_->setCurrentIndex(placeOf(form.separator, kSeparatorLetters));
  decimal_->setCurrentIndex(placeOf(form.decimal, kDecimalLetters));
  namesLine_->setValue(form.namesLine);
  firstLine_->setValue(form.firstLine);
  tables_->setMaximum(files);
  tables_->setValue(tablesOfOneRun);
  for (QWidget* box : std::initializer_list<QWidget*>{separator_, decimal_, namesLine_, firstLine_})
    box->setEnabled(isText);
  tables_->setEnabled(files > 1);
}

void TextFormBar::read() {
  if (displaying_) return;
  TextForm form;
  form.separator = kSeparatorLetters[static_cast<std::size_t>(separator_->currentIndex())];
  form.decimal = kDecimalLetters[static_cast<std::size_t>(decimal_->currentIndex())];
  form.namesLine = namesLine_->value();
  form.firstLine = firstLine_->value();
  emit edited(form, tables_->value());
}

} // namespace palp
