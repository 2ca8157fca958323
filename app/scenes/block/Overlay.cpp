#include "app/scenes/block/Overlay.h"

#include "app/scenes/charts/TextStyle.h"
#include "model/base/NumberText.h"

#include <vtkBrush.h>
#include <vtkCamera.h>
#include <vtkContext2D.h>
#include <vtkContextScene.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPen.h>
#include <vtkRect.h>
#include <vtkRenderer.h>
#include <vtkTextProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palp {

vtkStandardNewMacro(Overlay)

    namespace {

  constexpr double kMargin_px = 14;
  constexpr double kLine_px = 20;       ///< from line to line
  constexpr double kTriad_px = 24;      ///< length of its axes
  constexpr double kWordHeight_px = 18; ///< of a word with its ground

  void useText(vtkContext2D & painter, const Color& color, double size_px, bool bold = false) {
    setTextStyle(*painter.GetTextProp(), color, size_px, bold);
    painter.GetTextProp()->SetOrientation(0);
    painter.GetTextProp()->SetJustificationToLeft();
    painter.GetTextProp()->SetVerticalJustificationToCentered();
  }

} // namespace

std::vector<double> legendTicks(const ColorScale& colors, double height_px, double scale) {
  const int most = std::clamp(static_cast<int>(height_px / (28 * scale)), 2, 8);
  if (colors.logarithmic) return decadeTicks(colors.low, colors.high, most);
  std::vector<double> ticks = roundTicks(colors.low, colors.high, most);
  // One number gives no scale: a low legend gets two or three, closer together.
  const int closest = static_cast<int>(height_px / (16 * scale));
  for (int more = most + 1; ticks.size() < 3 && more <= closest; ++more)
    ticks = roundTicks(colors.low, colors.high, more);
  // Lower still: the ends of a scale that lies about 0 are as round as its user chose them.
  const bool ends = ticks.size() < 3 && colors.low == -colors.high && height_px > 28 * scale;
  const double said = ends ? numberIn(tickTexts({colors.low, 0, colors.high})[2]).value_or(0) : 0;
  if (ends && std::abs(said - colors.high) < 1e-6 * colors.high) ticks = {colors.low, 0, colors.high};
  return ticks;
}

namespace {

/// Decades have each as many digits as they need.
std::vector<std::string> legendTexts(const ColorScale& colors, const std::vector<double>& ticks) {
  if (!colors.logarithmic) return tickTexts(ticks);
  std::vector<std::string> texts;
  for (const double tick : ticks) texts.push_back(withDigits(tick, 3));
  return texts;
}

} // namespace

double legendWidth_px(vtkContext2D& painter, const ColorScale& colors, Theme theme, double scale) {
  useText(painter, palette(theme).text, 12 * scale);
  double widest = 0;
  for (const std::string& text : legendTexts(colors, legendTicks(colors, 200 * scale, scale)))
    widest = std::max(widest, textWidth_px(painter, text));
  const double numbers = (kLegendBar_px + 2 * kLegendTick_px) * scale + widest;
  useText(painter, palette(theme).text, 13 * scale, true);
  return std::max(numbers, textWidth_px(painter, colors.title()));
}

double legendRoom_px(const ColorScale& colors, double scale) {
  constexpr double kGap_px = 12, kStep_px = 20;
  double widest = 0;
  for (const std::string& text : legendTexts(colors, legendTicks(colors, 200 * scale, scale)))
    widest = std::max(widest, textWidth_px(text, 12 * scale));
  const double numbers = (kLegendBar_px + 2 * kLegendTick_px) * scale + widest;
  const double width = std::max(numbers, textWidth_px(colors.title(), 13 * scale, true));
  const double steps = std::ceil((width + (kMargin_px + kGap_px - kLegendRoom_px) * scale) / (kStep_px * scale));
  return (kLegendRoom_px + kStep_px * std::max(0.0, steps)) * scale;
}

void paintLegend(vtkContext2D& painter, const ColorScale& colors, const LegendPlace& place, Theme theme, double scale,
                 double right_px) {
  const Palette& ink = palette(theme);
  // One image: a call of the graphics library for each band costs 20 us by software.
  constexpr int kBands = 128;
  vtkNew<vtkImageData> bands;
  bands->SetDimensions(1, kBands, 1);
  bands->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  auto* byte = static_cast<unsigned char*>(bands->GetScalarPointer());
  for (int band = 0; band < kBands; ++band) {
    for (const double part : colors.shown(colors.at((band + 0.5) / kBands)))
      *byte++ = static_cast<unsigned char>(std::lround(255 * part));
    *byte++ = 255;
  }
  painter.GetPen()->SetLineType(vtkPen::NO_PEN);
  painter.DrawImage(vtkRectf(static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.width),
                             static_cast<float>(place.height)),
                    bands);
  painter.GetPen()->SetLineType(vtkPen::SOLID_LINE);
  painter.GetPen()->SetWidth(static_cast<float>(scale));
  painter.GetPen()->SetColorF(ink.text[0], ink.text[1], ink.text[2], 1);
  useText(painter, ink.text, 12 * scale);
  const std::vector<double> ticks = legendTicks(colors, place.height, scale);
  const std::vector<std::string> texts = legendTexts(colors, ticks);
  std::vector<float> ends;
  for (std::size_t k = 0; k < ticks.size(); ++k) {
    const double y = place.y + colors.share(ticks[k]) * place.height;
    const double x = place.x + place.width;
    ends.insert(ends.end(), {static_cast<float>(x), static_cast<float>(y),
                             static_cast<float>(x + kLegendTick_px * scale), static_cast<float>(y)});
    drawText(painter, x + 2 * kLegendTick_px * scale, y, texts[k]);
  }
  if (!ends.empty()) painter.DrawLines(ends.data(), static_cast<int>(ends.size() / 2));
  useText(painter, ink.text, 13 * scale, true);
  const double titleX = std::min(place.x, right_px - textWidth_px(painter, colors.title()));
  drawText(painter, titleX, place.y + place.height + kLegendTitle_px * scale, colors.title());
}

std::vector<Overlay::WordBox> Overlay::wordBoxes(vtkContext2D& painter) {
  vtkRenderer* renderer = GetScene()->GetRenderer();
  if (renderer == nullptr) return {};
  std::vector<WordBox> boxes;
  for (const PlacedText& word : words) {
    renderer->SetWorldPoint(word.place_mm.x(), word.place_mm.y(), word.place_mm.z(), 1);
    renderer->WorldToDisplay();
    const double* place = renderer->GetDisplayPoint();
    useText(painter, word.color, 13 * scale, true);
    const double width = textWidth_px(painter, word.text), sceneWidth = GetScene()->GetSceneWidth();
    const double x = std::clamp(place[0] - 0.5 * width, 4.0, std::max(4.0, sceneWidth - width - 4));
    boxes.push_back({&word, x, place[1], width});
    keepClear(painter, boxes.back());
  }
  // Short words, as numbers of areas, stay at their places; a longer one goes up until it covers none of them.
  std::stable_sort(boxes.begin(), boxes.end(),
                   [](const WordBox& a, const WordBox& b) { return a.word->text.size() < b.word->text.size(); });
  const auto apart = [this](const WordBox& a, const WordBox& b) {
    return std::abs(a.y - b.y) >= kWordHeight_px * scale || a.x > b.x + b.width + 8 * scale ||
           b.x > a.x + a.width + 8 * scale;
  };
  for (auto box = boxes.begin(); box != boxes.end(); ++box)
    for (bool moved = true; std::exchange(moved, false);)
      for (auto other = boxes.begin(); other != box; ++other) {
        if (apart(*other, *box) || other->word->text.size() == box->word->text.size()) continue;
        box->y = other->y + (kWordHeight_px + 1) * scale;
        moved = true;
      }
  // Labels on the lines move next to them, or below them and below other text where there is no room.
  for (WordBox& box : boxes) {
    const double beside = kMargin_px * scale + widest_ + 12 * scale;
    if (box.y + 0.5 * kWordHeight_px * scale <= linesEnd() || box.x >= beside - 4 * scale) continue;
    if (beside + box.width + 4 <= GetScene()->GetSceneWidth() && !legend) {
      box.x = beside;
      continue;
    }
    box.y = linesEnd() - 0.5 * kWordHeight_px * scale;
    for (bool moved = true; std::exchange(moved, false);)
      for (const WordBox& other : boxes) {
        if (&other == &box || apart(other, box)) continue;
        box.y = other.y - (kWordHeight_px + 1) * scale;
        moved = true;
      }
  }
  return boxes;
}

double Overlay::linesEnd() {
  return GetScene()->GetSceneHeight() - (kMargin_px + kLine_px * static_cast<double>(broken_.size())) * scale;
}

double Overlay::legendBar_px() {
  return std::min(0.55 * GetScene()->GetSceneHeight(), 320 * scale);
}

/// Of the next line: a low view has its legend next to the lines.
double Overlay::lineRoom_px(vtkContext2D& painter) {
  const double margin = kMargin_px * scale, whole = GetScene()->GetSceneWidth() - 2 * margin;
  if (!legend) return whole;
  const double titleEnd =
      0.5 * (GetScene()->GetSceneHeight() + legendBar_px()) + (kLegendTitle_px + 0.5 * kLine_px) * scale;
  const bool above = linesEnd() - kLine_px * scale >= titleEnd;
  return above ? whole : whole - margin - legendWidth_px(painter, *legend, theme, scale);
}

void Overlay::breakLines(vtkContext2D& painter) {
  broken_.clear();
  widest_ = 0;
  for (const std::string& line : lines) {
    std::string rest = line;
    while (!rest.empty()) {
      const bool first = broken_.empty();
      const double room = lineRoom_px(painter);
      useText(painter, palette(theme).text, (first ? 14 : 12) * scale, first);
      std::string part = rest;
      double width = textWidth_px(painter, part);
      for (std::size_t cut = 0; !first && width > room && (cut = part.rfind(' ')) != std::string::npos && cut > 0;
           width = textWidth_px(painter, part))
        part.resize(cut);
      rest.erase(0, part.size() + 1); // with the space
      widest_ = std::max(widest_, width);
      broken_.push_back(std::move(part));
    }
  }
}

void Overlay::keepClear(vtkContext2D& painter, WordBox& box) {
  const double margin = kMargin_px * scale, half = 0.5 * kWordHeight_px * scale;
  if (legend) {
    const double free = GetScene()->GetSceneWidth() - 2 * margin - legendWidth_px(painter, *legend, theme, scale);
    box.x = std::max(4.0, std::min(box.x, free - box.width));
  }
  if (box.x < margin + widest_ + 8 * scale) box.y = std::min(box.y, linesEnd() - half);
  box.y = std::min(box.y, GetScene()->GetSceneHeight() - half - 2);
}

void Overlay::paintTriad(vtkContext2D& painter) {
  vtkRenderer* renderer = GetScene()->GetRenderer();
  if (renderer == nullptr) return;
  const vtkMatrix4x4& view = *renderer->GetActiveCamera()->GetViewTransformMatrix();
  struct Axis {
    double x, y, depth;
    const char* name;
    Color color;
  };
  const bool light = theme == Theme::Light;
  const std::array<Color, 3> colors{light ? Color{0.78, 0.16, 0.16} : Color{1.0, 0.45, 0.42},
                                    light ? Color{0.10, 0.50, 0.16} : Color{0.42, 0.85, 0.45},
                                    light ? Color{0.10, 0.34, 0.80} : Color{0.50, 0.68, 1.0}};
  constexpr std::array<const char*, 3> kNames{"x", "y", "z"};
  std::array<Axis, 3> axes{};
  for (int d = 0; d < 3; ++d) {
    const auto k = static_cast<std::size_t>(d);
    axes[k] = {view.GetElement(0, d), view.GetElement(1, d), view.GetElement(2, d), kNames[k], colors[k]};
  }
  // What points at the viewer is drawn last.
  std::sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return a.depth < b.depth; });
  const double centre = (kMargin_px + kTriad_px) * scale;
  for (const Axis& axis : axes) {
    const double x = centre + kTriad_px * scale * axis.x, y = centre + kTriad_px * scale * axis.y;
    painter.GetPen()->SetLineType(vtkPen::SOLID_LINE);
    painter.GetPen()->SetWidth(static_cast<float>(2 * scale));
    painter.GetPen()->SetColorF(axis.color[0], axis.color[1], axis.color[2], 1);
    painter.DrawLine(static_cast<float>(centre), static_cast<float>(centre), static_cast<float>(x),
                     static_cast<float>(y));
    useText(painter, axis.color, 12 * scale, true);
    drawText(painter, x + 7 * scale * axis.x - 3 * scale, y + 7 * scale * axis.y, axis.name);
  }
}

void Overlay::paintGround(vtkContext2D& painter, double x, double y, double width) const {
  const Color& ground = palette(theme).ground;
  painter.GetPen()->SetLineType(vtkPen::NO_PEN);
  painter.GetBrush()->SetColorF(ground[0], ground[1], ground[2], 0.7);
  painter.DrawRect(static_cast<float>(x - 4 * scale), static_cast<float>(y - 0.5 * kWordHeight_px * scale),
                   static_cast<float>(width + 8 * scale), static_cast<float>(kWordHeight_px * scale));
}

void Overlay::paintWords(vtkContext2D& painter) {
  for (const WordBox& box : wordBoxes(painter)) {
    paintGround(painter, box.x, box.y, box.width);
    useText(painter, box.word->color, 13 * scale, true);
    drawText(painter, box.x, box.y, box.word->text);
  }
}

bool Overlay::Paint(vtkContext2D* painter) {
  const double width = GetScene()->GetSceneWidth();
  const double height = GetScene()->GetSceneHeight();
  const double margin = kMargin_px * scale;
  breakLines(*painter);
  paintWords(*painter);
  if (triad) paintTriad(*painter);
  double y = height - margin - 8 * scale;
  for (std::size_t k = 0; k < broken_.size(); ++k) {
    useText(*painter, palette(theme).text, (k == 0 ? 14 : 12) * scale, k == 0);
    paintGround(*painter, margin, y, textWidth_px(*painter, broken_[k])); // in a low view the block lies under it
    drawText(*painter, margin, y, broken_[k]);
    y -= kLine_px * scale;
  }
  if (legend) {
    const double need = legendWidth_px(*painter, *legend, theme, scale);
    const double bar = legendBar_px();
    paintLegend(*painter, *legend, {width - margin - need, (height - bar) / 2, kLegendBar_px * scale, bar}, theme,
                scale, width - margin);
  }
  return true;
}

} // namespace palp
