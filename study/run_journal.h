// What a run of several searches, in turns, keeps of them: each goes on from where it was.
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "corank/result/files/checkpoint.h"
#include "corank/solve/store/journal.h"

namespace corank::study {

class RunJournal : public solve::Journal {
 public:
  struct Plan {
    std::filesystem::path path = {};  ///< of the checkpoint's file; empty: there is none
    double every = 60;                ///< seconds between two checkpoints, at least
    bool keep_end = false;            ///< take_search() is to be what a limit has left
    /// Bytes, of what a limit has left. It is made in memory and written within a part of a second: more is a matter for a
    /// checkpoint.
    std::uint64_t most_in_result = std::uint64_t{1} << 28;
  };
  /// Of all seconds, checkpoints take no more than this share: where one takes long, the next comes later.
  static constexpr double kMostShare = 0.02;

  /// `from`: what a former run has kept, or the arguments and files of a new one.
  RunJournal(result::Checkpoint from, Plan plan);

  /// The run has so many searches; 1 unless another number is said.
  void expect(std::size_t searches) { known_.states.resize(searches); }
  /// It is the turn of one of them: the state from which it goes on, or nothing. Throws result::ResultFileError where that
  /// is damaged.
  std::optional<solve::SearchState> begin(std::size_t search, const solve::Prepared& prepared);
  /// Bytes of the states of searches whose turn it is not.
  std::uint64_t bytes_of_others() const;
  bool due() override;
  void keep(const solve::SearchView& state, solve::Moment moment) override;

  /// What of the run is to go into its result (result::Result::search): nothing, unless the plan says so.
  std::string take_search() { return std::move(search_); }
  /// Bytes of what a limit has left, nearly, where that is too much for a result; else 0.
  std::uint64_t left_out() const { return left_out_; }

 private:
  using Clock = std::chrono::steady_clock;
  void plan_next(Clock::time_point begun);

  result::Checkpoint known_;
  const Plan plan_;
  bool ended_ = false;
  std::atomic<Clock::duration::rep> next_;
  std::atomic<Clock::duration::rep> asked_{0};
  std::string search_;
  std::uint64_t left_out_ = 0;
};

}  // namespace corank::study
