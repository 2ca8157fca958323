#include "app/gui/network/NetworkBound.h"

#include "model/base/Cancelled.h"
#include "model/base/Error.h"

#include <limits>

namespace palp {

namespace {

NoiseBound none() {
  const Eigen::VectorXd nothing = Eigen::VectorXd::Constant(3, std::numeric_limits<double>::quiet_NaN());
  return {nothing, nothing};
}

} // namespace

NetworkBound::NetworkBound(NetworkSession& session, QObject* parent) : QObject(parent), session_(session) {
  connect(&runner_, &JobRunner::finished, this, [this](bool cancelled) {
    if (!cancelled) return;
    for (const auto& question : questions_) // after Cancel none is shown
      if (!question->answer) question->answer = none();
    emit changed();
  });
}

const NoiseBound* NetworkBound::of(const NetworkSettings& settings) {
  constexpr std::size_t kMost = 20;
  if (!session_.upToDate() || !(settings.testNoise > 0) || session_.samples()->training.hasPlaces()) return nullptr;
  if (samples_.lock() != session_.sharedSamples()) {
    samples_ = session_.sharedSamples();
    questions_.clear();
  }
  for (const auto& known : questions_)
    if (known->input == settings.input && known->rows == settings.rows && known->noise == settings.testNoise)
      return known->answer ? &*known->answer : nullptr;
  if (questions_.size() == kMost) questions_.erase(questions_.begin());
  questions_.push_back(std::make_unique<Question>(Question{settings.input, settings.rows, settings.testNoise}));
  compute();
  return nullptr;
}

/// All questions that are open: a new work replaces the one before.
void NetworkBound::compute() {
  std::vector<Question> open;
  for (const auto& question : questions_)
    if (!question->answer) open.push_back(*question);
  runner_.start(
      tr("Computing the error bounds"),
      [this, open, samples = session_.sharedSamples()](const std::stop_token& stop, JobProgress&) -> JobRunner::Taking {
        std::vector<Question> done = open;
        for (Question& question : done) {
          throwIfStopped(stop);
          try {
            question.answer = noiseBound(samples->training, question.input,
                                         rowsNamed(question.rows, samples->training.rowWires), question.noise);
          } catch (const Error&) { // too few samples, say
            question.answer = none();
          }
        }
        return [this, done, samples] {
          if (samples != samples_.lock()) return;
          for (const Question& answer : done)
            for (const auto& question : questions_)
              if (question->input == answer.input && question->rows == answer.rows && question->noise == answer.noise)
                *question = answer;
          emit changed();
        };
      });
}

} // namespace palp
