#pragma once

#include "solver/HyperelasticProblem.h"
#include "solver/batch/ConvergenceMonitor.h"
#include "solver/batch/LoadBatch.h"
#include "solver/contact/ColumnContact.h"
#include "solver/contact/TopCompliance.h"

#include <array>
#include <memory>
#include <stop_token>

namespace palp {

/// Contact of the loads with indenters in a batch's columns (ColumnContact.h has the states of one). Each starts and
/// ends independently, so that a converged column need not wait for the others of its block. Calls per iteration: begin
/// (new loads), iterate, ConvergenceMonitor::judge, continueIncrements; end where a load is finished.
class ContactColumns {
public:
  /// `top` is null where no load has indenters.
  ContactColumns(std::shared_ptr<const TopCompliance> top, const HyperelasticProblem& problem)
      : top_(std::move(top)), problem_(problem) {}

  static bool isTouch(const LoadCase& load) { return !load.indenters.empty(); }
  static bool hasFriction(const LoadCase& load);

  /// Starts a load with indenters from rest; `inSingle` as in LoadBatch, the same for all columns of a block.
  void begin(int column, const LoadCase& load, LoadBatch& batch, ConvergenceMonitor& watch, bool inSingle);
  void end(int column) { contacts_[column].reset(); }
  void move(int from, int to) { contacts_[to] = std::move(contacts_[from]); }

  /// Does one iteration of all active columns, with and without indenters. Columns without a contact equilibrium fail.
  void iterate(LoadBatch& batch, ConvergenceMonitor& watch, const std::stop_token& stop) const;
  /// Starts the next load increment of columns that have converged at the present one.
  void continueIncrements(LoadBatch& batch, ConvergenceMonitor& watch,
                          const std::array<bool, batchColumns>& wasActive) const;

private:
  std::shared_ptr<const TopCompliance> top_;
  const HyperelasticProblem& problem_;
  std::array<std::unique_ptr<ColumnContact>, batchColumns> contacts_;
};

} // namespace palp
