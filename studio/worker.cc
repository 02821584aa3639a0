#include "corank/studio/worker.h"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

namespace corank::studio {
namespace {

/// Where nobody reads any more, nothing is left to do.
void write_line(int channel, const std::string& line) {
  const std::string text = line + '\n';
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = ::send(channel, text.data() + at, text.size() - at, MSG_NOSIGNAL);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(0);
    at += static_cast<std::size_t>(n);
  }
}

/// The newest request that is not begun, and whether the answer that is being made is to end.
class Desk {
 public:
  void put(std::string line) {
    const std::lock_guard lock(mutex_);
    next_ = std::move(line);
    stop_ = true;
    changed_.notify_one();
  }
  std::string take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return next_.has_value(); });
    stop_ = false;
    std::string line = std::move(*next_);
    next_.reset();
    return line;
  }
  const std::atomic<bool>& stop() const { return stop_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::string> next_;
  std::atomic<bool> stop_{false};
};

}  // namespace

void work(int channel, const SessionLimits& limits) {
  Desk desk;
  std::thread([&] {
    const Emit emit = [channel](const std::string& line) { write_line(channel, line); };
    for (;;) {
      try {
        const Request request = parse_request(desk.take());
        answer(request, emit, desk.stop(), limits);
      } catch (const RequestError& error) {
        emit(nlohmann::ordered_json{{"event", "bad"}, {"message", error.what()}}.dump());
      }
    }
  }).detach();
  std::string rest;
  std::array<char, 1 << 16> bytes;
  for (;;) {
    const ssize_t n = ::read(channel, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) ::_exit(0);
    rest.append(bytes.data(), static_cast<std::size_t>(n));
    for (std::size_t end; (end = rest.find('\n')) != std::string::npos; rest.erase(0, end + 1))
      desk.put(rest.substr(0, end));
  }
}

}  // namespace corank::studio
