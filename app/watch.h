// Work that has to end by a time or on Ctrl-C: a flag asks for the end; where the work does not look at it, a watch ends the
// program with a statement.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace corank::app {

/// For the time of its life, SIGINT and SIGTERM set stop(); a second signal exits with status 128 + its number.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static const std::atomic<bool>& stop();
};

class Watch {
 public:
  using Duration = std::chrono::duration<double>;
  /// How long the work may go on after the flag was set: a limit holds within a second.
  static constexpr Duration kGrace{0.8};

  /// A number of the piece of work that is done just now and does not look at the flag; 0: there is no such piece.
  using Work = std::uint64_t;

  /// Sets stop() after `seconds` (0: never), or once `interrupt` is set. Where later one piece of `deaf` work goes on for a
  /// `grace`, or this object lives that long and there is no such function, `give_up` is called with the stage, from another
  /// thread; it is to say what is known and to end the program.
  Watch(double seconds, const std::atomic<bool>& interrupt, std::function<void(const std::string& stage)> give_up,
        Duration grace = kGrace, std::function<Work()> deaf = {});
  ~Watch();

  const std::atomic<bool>& stop() const { return stop_; }
  /// What is done from now on, in words for the statement: "reading the file".
  void enter(const std::string& stage);
  /// From now on give_up is not called any more: the work has ended, and says itself what it found.
  void done();

 private:
  void watch(double seconds, const std::atomic<bool>& interrupt, Duration grace);

  std::function<void(const std::string&)> give_up_;
  std::function<Work()> deaf_;
  std::atomic<bool> stop_{false};
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string stage_;
  bool done_ = false;
  std::thread thread_;
};

}  // namespace corank::app
