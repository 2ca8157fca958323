// Names of files and designs are shown as they are written, whatever they look like.

#include "tests/app/gui/WindowFixture.h"

#include <QLabel>
#include <QTextDocument>

namespace palp {
namespace {

class Labels : public WindowFixture {
protected:
  /// What a reader sees of it.
  static QString seen(const QLabel& label) {
    if (label.textFormat() != Qt::RichText) return label.text();
    QTextDocument shown;
    shown.setHtml(label.text());
    return shown.toPlainText();
  }
};

TEST_F(Labels, OfEverySceneSayWhetherTheirTextIsMarkup) {
  for (const char* scene : {"design", "deformation", "resistance", "network", "live", "reports"}) {
    ASSERT_TRUE(window.showScene(scene)) << scene;
    settle();
    for (const QLabel* label : window.findChildren<QLabel*>()) {
      if (!label->isVisible()) continue;
      EXPECT_NE(label->textFormat(), Qt::AutoText) << scene << ": " << label->text().toStdString();
    }
  }
}

TEST_F(Labels, ShowADesignsNameThatLooksLikeMarkupAsItIsWritten) {
  Project next = workbench.project();
  DesignsCompared& compared = next.studies.compared.emplace();
  compared.earlier = compared.now = next.design;
  std::get<MooneyRivlin>(compared.earlier.material.law).c10_MPa *= 2;
  compared.name = "<b>x</b> & <i>y";
  compared.words = "Largest displacement <b>0.1 mm</b> now.<br><img src=\"y\">";
  workbench.edit("compare", next);
  ASSERT_TRUE(window.showScene("design"));
  const auto& words = find<QLabel>("comparison");
  EXPECT_TRUE(seen(words).contains("<b>x</b> & <i>y")) << seen(words).toStdString();
  EXPECT_TRUE(seen(words).contains("0.1 mm now.\n<img src=\"y\">")) << seen(words).toStdString();
}

} // namespace
} // namespace palp
