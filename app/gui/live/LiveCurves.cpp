#include "app/gui/live/LiveCurves.h"

#include "app/gui/live/LiveDrawings.h"
#include "app/gui/views/StripChart.h"

#include <algorithm>
#include <utility>

namespace palp {

namespace {

constexpr std::size_t kMostCells = 7;

} // namespace

LiveCurves::LiveCurves(LiveHost& host, QWidget* parent) : QSplitter(Qt::Horizontal, parent), host_(host) {
  forces_ = new StripChart;
  forces_->setObjectName("forceCurves");
  forces_->setAccessibleName(tr("Decoded force over time"));
  changes_ = new StripChart;
  changes_->setObjectName("changeCurves");
  changes_->setAccessibleName(tr("dR/R of some cells over time"));
  for (StripChart* chart : {forces_, changes_}) {
    addWidget(chart);
    connect(chart, &StripChart::heldNow, this, &LiveCurves::hold);
    connect(chart, &StripChart::released, this, &LiveCurves::draw);
    connect(chart, &StripChart::message, this, &LiveCurves::message);
  }
}

const Decoder* LiveCurves::decoder() const {
  return host_.network().decoder() ? &*host_.network().decoder() : nullptr;
}

/// A recording's time counts from its first report.
StripSpec LiveCurves::timed(StripSpec spec) const {
  if (host_.replay() != nullptr) spec.zero_s = host_.replay()->begin_s.load();
  return spec;
}

void LiveCurves::draw() {
  if (std::exchange(opened_, host_.openings()) != host_.openings()) // of another source: what was held is no more
    for (StripChart* chart : {forces_, changes_}) chart->release();
  chooseCells();
  forces_->setChart(timed(forceCurves(host_.history(), host_.settings(), decoder())));
  changes_->setChart(timed(changeCurves(host_.history(), host_.settings(), cells_)));
}

/// Curves that are shown contain all existing values.
void LiveCurves::hold() {
  LiveSettings all = host_.settings();
  all.window_s = LiveHistory::kLongest_s;
  if (sender() == forces_) forces_->holdChart(timed(forceCurves(host_.history(), all, decoder())));
  if (sender() == changes_) changes_->holdChart(timed(changeCurves(host_.history(), all, cells_)));
}

void LiveCurves::setTheme(Theme theme) {
  forces_->setTheme(theme);
  changes_->setTheme(theme);
}

/// The cells at the middles of the load areas, until the user chooses others.
void LiveCurves::chooseCells() {
  const LiveFrame* last = host_.history().last();
  if (cellsChosen_ || last == nullptr) return;
  cells_ = areaCells(host_.sensor(), last->change.rows(), last->change.cols());
  if (cells_.size() > kMostCells) cells_.resize(kMostCells);
}

void LiveCurves::toggleCell(int row, int column) {
  if (!cellsChosen_) cells_.clear();
  const auto found = std::find(cells_.begin(), cells_.end(), std::array{row, column});
  if (found != cells_.end()) {
    cells_.erase(found);
  } else {
    if (cells_.size() == kMostCells) cells_.erase(cells_.begin());
    cells_.push_back({row, column});
  }
  cellsChosen_ = !cells_.empty(); // none: back to the areas' middles
  draw();
}

std::optional<std::array<int, 2>> LiveCurves::chosenCell() const {
  return cellsChosen_ ? std::optional(cells_.back()) : std::nullopt;
}

} // namespace palp
