#pragma once

#include "app/gui/views/VtkView.h"
#include "app/scenes/charts/Chart.h"

namespace palp {

/// A chart that can be zoomed with the wheel and moved; double click shows all of it again.
class ChartView : public VtkView {
  Q_OBJECT

public:
  explicit ChartView(QWidget* parent = nullptr);
  ~ChartView() override;

  void setChart(const ChartSpec& spec);
  void setTheme(Theme theme);
  [[nodiscard]] const ChartSpec& chart() const { return spec_; }
  /// Faint, for what does not hold any more.
  void setFaint(bool faint);
  [[nodiscard]] bool faint() const { return faint_; }

protected:
  [[nodiscard]] bool standsStill() const override { return true; }
  void render(QImage& image) override;
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;
  [[nodiscard]] QString table() const override;

private:
  struct Parts;
  ChartView(std::unique_ptr<Parts> parts, QWidget* parent);
  void fill();
  /// Nothing to draw but words.
  [[nodiscard]] bool empty() const;
  [[nodiscard]] QColor ground() const;

  std::unique_ptr<Parts> parts_;
  ChartSpec spec_;
  Theme theme_ = Theme::Light;
  bool faint_ = false;
};

} // namespace palp
