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

protected:
  void paintEvent(QPaintEvent* event) override;
  void changeEvent(QEvent* event) override;

private:
  struct Parts;
  ChartView(std::unique_ptr<Parts> parts, QWidget* parent);
  void fill();

  std::unique_ptr<Parts> parts_;
  ChartSpec spec_;
  Theme theme_ = Theme::Light;
};

} // namespace palp
