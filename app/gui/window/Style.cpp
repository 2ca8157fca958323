#include "app/gui/window/Style.h"

#include <QApplication>
#include <QFile>
#include <QFontDatabase>
#include <QPainter>
#include <QPalette>
#include <QProxyStyle>
#include <QRegularExpression>
#include <QSettings>
#include <QStyleFactory>
#include <QStyleOption>

#include <algorithm>

namespace palp {

namespace {

constexpr const char* kTextKey = "textPercent";

/// Fusion draws its outlines darker than the ground, which on black is nothing: these are white.
class OutlinedStyle : public QProxyStyle {
public:
  OutlinedStyle() : QProxyStyle("Fusion") {}

  void drawPrimitive(PrimitiveElement element, const QStyleOption* option, QPainter* painter,
                     const QWidget* widget) const override {
    QProxyStyle::drawPrimitive(element, option, painter, widget);
    if (element == PE_PanelButtonCommand || element == PE_IndicatorCheckBox || element == PE_FrameLineEdit)
      outline(*painter, option->rect, option->palette);
  }
  void drawComplexControl(ComplexControl control, const QStyleOptionComplex* option, QPainter* painter,
                          const QWidget* widget) const override {
    QProxyStyle::drawComplexControl(control, option, painter, widget);
    if (control == CC_SpinBox || control == CC_ComboBox || control == CC_ScrollBar)
      outline(*painter, option->rect, option->palette);
    if (control == CC_ScrollBar)
      outline(*painter, subControlRect(control, option, SC_ScrollBarSlider, widget), option->palette);
    if (control != CC_Slider) return;
    const QRect handle = subControlRect(control, option, SC_SliderHandle, widget);
    painter->save();
    painter->setClipRegion(QRegion(option->rect) - handle);
    outline(*painter, subControlRect(control, option, SC_SliderGroove, widget), option->palette);
    painter->restore();
    outline(*painter, handle, option->palette);
  }

  void drawControl(ControlElement element, const QStyleOption* option, QPainter* painter,
                   const QWidget* widget) const override {
    QProxyStyle::drawControl(element, option, painter, widget);
    if (element != CE_TabBarTabShape && element != CE_HeaderSection && element != CE_ProgressBarGroove) return;
    outline(*painter, option->rect, option->palette);
    if (element == CE_TabBarTabShape && option->state.testFlag(State_Selected)) // its ground is that of the others
      painter->fillRect(option->rect.adjusted(2, 2, -2, 5 - option->rect.height()),
                        option->palette.color(QPalette::Highlight));
  }

private:
  static void outline(QPainter& painter, const QRect& rect, const QPalette& colors) {
    painter.save();
    painter.setBrush(Qt::NoBrush);
    painter.setPen(colors.color(QPalette::WindowText));
    painter.drawRect(rect.adjusted(0, 0, -1, -1));
    painter.restore();
  }
};

/// White on black, yellow for what is chosen: contrasts of 19:1 and 15:1.
QPalette highContrast() {
  QPalette colors;
  const QColor ground = Qt::black, ink = Qt::white, chosen(0xffd400), faint(0xb8b8b8);
  for (const auto group : {QPalette::Active, QPalette::Inactive, QPalette::Disabled}) {
    const QColor text = group == QPalette::Disabled ? faint : ink;
    for (const auto role : {QPalette::Window, QPalette::Base, QPalette::AlternateBase, QPalette::Button,
                            QPalette::ToolTipBase, QPalette::Dark})
      colors.setColor(group, role, ground);
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
      colors.setColor(group, role, text);
    for (const auto role : {QPalette::Light, QPalette::Mid, QPalette::Midlight}) colors.setColor(group, role, faint);
    colors.setColor(group, QPalette::PlaceholderText, QColor(0xd0d0d0));
    colors.setColor(group, QPalette::Highlight, group == QPalette::Disabled ? faint : chosen);
    colors.setColor(group, QPalette::HighlightedText, ground);
    colors.setColor(group, QPalette::ToolTipText, ink);
    colors.setColor(group, QPalette::Link, chosen);
  }
  return colors;
}

QPalette widgetColors(Theme theme) {
  if (theme == Theme::Contrast) return highContrast();
  const bool light = theme == Theme::Light;
  QPalette colors;
  const QColor window = light ? QColor(0xf3f4f6) : QColor(0x25282d);
  const QColor base = light ? QColor(0xffffff) : QColor(0x343a42);
  const QColor text = light ? QColor(0x20242a) : QColor(0xe6e8eb);
  const QColor accent = light ? QColor(0x0a6ebd) : QColor(0x3d9be0);
  for (const auto group : {QPalette::Active, QPalette::Inactive, QPalette::Disabled}) {
    const bool disabled = group == QPalette::Disabled;
    const QColor ink = disabled ? (light ? QColor(0x9aa0a8) : QColor(0x757b84)) : text;
    colors.setColor(group, QPalette::Window, window);
    colors.setColor(group, QPalette::Base, base);
    colors.setColor(group, QPalette::AlternateBase, light ? QColor(0xf7f8fa) : QColor(0x22252a));
    colors.setColor(group, QPalette::Button, light ? QColor(0xe9ebee) : QColor(0x32363c));
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
      colors.setColor(group, role, ink);
    colors.setColor(group, QPalette::Light, light ? QColor(0xffffff) : QColor(0x4a515b));
    colors.setColor(group, QPalette::Mid, light ? QColor(0xb9bec6) : QColor(0x4a515b));
    colors.setColor(group, QPalette::Dark, light ? QColor(0x9aa0a8) : QColor(0x15171a));
    colors.setColor(group, QPalette::PlaceholderText, light ? QColor(0x8a9099) : QColor(0x858b94));
    colors.setColor(group, QPalette::Highlight, disabled ? QColor(0x808890) : accent);
    colors.setColor(group, QPalette::HighlightedText, Qt::white);
    colors.setColor(group, QPalette::ToolTipBase, light ? QColor(0xfffff0) : QColor(0x3a3f47));
    colors.setColor(group, QPalette::ToolTipText, text);
    colors.setColor(group, QPalette::Link, accent);
  }
  return colors;
}

/// Sizes like @13px follow the text.
QString scaled(QString sheet, double scale) {
  static const QRegularExpression size("@(\\d+)px");
  for (QRegularExpressionMatch match = size.match(sheet); match.hasMatch(); match = size.match(sheet))
    sheet.replace(match.captured(0), QString("%1px").arg(qRound(match.captured(1).toInt() * scale)));
  return sheet;
}

} // namespace

void applyTheme(QApplication& application, Theme theme) {
  if (theme == Theme::Contrast)
    QApplication::setStyle(new OutlinedStyle); // the application's
  else
    QApplication::setStyle(QStyleFactory::create("Fusion"));
  QApplication::setPalette(widgetColors(theme));
  const double scale = textPercent() / 100.0;
  QFont font = QFontDatabase::systemFont(QFontDatabase::GeneralFont);
  if (font.pointSizeF() > 0)
    font.setPointSizeF(font.pointSizeF() * scale);
  else
    font.setPixelSize(qRound(font.pixelSize() * scale));
  QApplication::setFont(font);
  QFile sheet(":/style/palp.qss");
  if (!sheet.open(QIODevice::ReadOnly)) return;
  QString text = scaled(QString::fromUtf8(sheet.readAll()), scale);
  text.replace("@problem", theme == Theme::Light ? "#d4303c" : "#ff707a"); // readable on its ground
  application.setStyleSheet(text);
}

int textPercent() {
  return std::clamp(QSettings().value(kTextKey, 100).toInt(), kSmallestText_percent, kLargestText_percent);
}

void setTextPercent(int percent) {
  QSettings().setValue(kTextKey, percent);
}

} // namespace palp
