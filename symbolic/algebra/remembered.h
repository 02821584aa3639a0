// Answers that are asked for again and again while one question is answered, and for which GiNaC takes its time.
#pragma once

#include <cstddef>
#include <deque>
#include <utility>

#include "corank/symbolic/algebra/ginac_lock.h"

namespace corank::symbolic {

/// The last `most` answers, each with what was asked. Any thread may ask: GiNaC's lock is held meanwhile.
template <class Asked, class Found>
class Remembered {
 public:
  explicit Remembered(std::size_t most) : most_(most) {}

  /// What was found of something `alike`, else find(asked).
  Found of(const Asked& asked, const auto& alike, const auto& find) {
    const GinacLock lock;
    for (const auto& [known, found] : answers_)
      if (alike(known, asked)) return found;
    Found result = find(asked);
    answers_.emplace_front(asked, result);
    if (answers_.size() > most_) answers_.pop_back();
    return result;
  }

 private:
  std::size_t most_;
  std::deque<std::pair<Asked, Found>> answers_;
};

}  // namespace corank::symbolic
