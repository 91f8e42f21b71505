#pragma once

#include <vector>

#include "perimorph/base/errors.hpp"
#include "perimorph/base/parallel.hpp"

namespace perimorph::base {

/// Questions to other ranks about what each of them has, and their answers.
/// @tparam Question trivially copyable
template <class Question>
class Inquiry {
 public:
  /// Sends the questions. Collective; the communicator must outlive this.
  /// @param ranks     whom each question is for, (n_questions)
  /// @param questions (n_questions)
  Inquiry(const Comm& comm, std::vector<int> ranks, const std::vector<Question>& questions)
      : comm_(comm), ranks_(std::move(ranks)) {
    PERIMORPH_ASSERT(ranks_.size() == questions.size(), "{} questions to {} ranks", questions.size(), ranks_.size());
    std::vector<std::vector<Question>> outgoing(comm.getSize());
    for (std::size_t i = 0; i < questions.size(); ++i) outgoing[ranks_[i]].push_back(questions[i]);
    received_ = base::exchange(comm, outgoing);
  }

  /// Whom each question was for, (n_questions).
  const std::vector<int>& ranks() const { return ranks_; }
  /// What each rank has asked this one, (n_ranks).
  const std::vector<std::vector<Question>>& received() const { return received_; }

  /// Answers what the others have asked, and returns what they answer. Collective.
  /// @param to_others (n_ranks), for each rank the answers to what it has asked; Answer is trivially copyable
  /// @return in the order of the questions, (n_questions)
  template <class Answer>
  std::vector<Answer> send_back(const std::vector<std::vector<Answer>>& to_others) const {
    const auto incoming = base::exchange(comm_, to_others);
    std::vector<std::size_t> next(incoming.size(), 0);
    std::vector<Answer> all;
    all.reserve(ranks_.size());
    for (const int rank : ranks_) all.push_back(incoming[rank][next[rank]++]);
    return all;
  }

  /// The same. Collective.
  /// @param answer_to from Question to Answer
  template <class Answer, class AnswerTo>
  std::vector<Answer> answers(const AnswerTo& answer_to) const {
    std::vector<std::vector<Answer>> to_others(received_.size());
    for (std::size_t rank = 0; rank < received_.size(); ++rank) {
      to_others[rank].reserve(received_[rank].size());
      for (const Question& question : received_[rank]) to_others[rank].push_back(answer_to(question));
    }
    return send_back(to_others);
  }

 private:
  const Comm& comm_;
  std::vector<int> ranks_;
  std::vector<std::vector<Question>> received_;
};

}  // namespace perimorph::base
