#include "corank/studio/window.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>

#include "corank/studio/worker.h"

namespace corank::studio {
namespace asio = boost::asio;
using Error = boost::system::error_code;
namespace {

constexpr std::size_t kMostWaiting = 256 << 20;   // bytes for a page that does not read
constexpr std::chrono::milliseconds kGrace{700};  // for an answer to end
constexpr std::chrono::seconds kHeartbeat{15};

}  // namespace

Window::Window(asio::io_context& context, Socket page, SessionLimits limits, std::function<void()> on_end)
    : context_(context),
      page_(std::move(page)),
      channel_(context),
      timer_(context),
      heart_(context),
      limits_(limits),
      on_end_(std::move(on_end)) {}

Window::~Window() { end_process(); }

void Window::start() {
  to_page_.push_back(
      "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nConnection: close\r\n"
      "X-Content-Type-Options: nosniff\r\n\r\n: corank studio\n\n");
  write_page();
  watch_page();
  beat();
  start_process();
}

void Window::ask(std::uint64_t number, std::string line) {
  asked_ = number, line_ = std::move(line);
  send_request();
  timer_.expires_after(kGrace);
  timer_.async_wait([self = shared_from_this(), number](Error error) {
    if (error || self->ended_ || self->begun_ >= number) return;
    self->end_process();
    self->start_process();
    self->send_request();
  });
}

void Window::end() {
  if (ended_) return;
  ended_ = true;
  timer_.cancel();
  heart_.cancel();
  Error ignored;
  page_.close(ignored);
  end_process();
  on_end_();
}

void Window::start_process() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return end();
  context_.notify_fork(asio::io_context::fork_prepare);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) {
    ::dup2(ends[1], 3);
    ::close_range(4, ~0U, 0);
    std::signal(SIGINT, SIG_IGN);  // Ctrl-C in a terminal is for this program, which ends the process
    std::signal(SIGTERM, SIG_DFL);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(0);
    work(3, limits_);
  }
  context_.notify_fork(asio::io_context::fork_parent);
  ::close(ends[1]);
  if (process_ < 0) {
    ::close(ends[0]);
    return end();
  }
  channel_ = Channel(context_, asio::local::stream_protocol(), ends[0]);
  ++generation_;
  from_process_.clear();
  to_process_.clear();
  read_process();
}

void Window::end_process() {
  Error ignored;
  channel_.close(ignored);
  if (process_ <= 0) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

void Window::send_request() {
  const bool idle = to_process_.empty();
  to_process_.resize(std::min<std::size_t>(to_process_.size(), 1));  // what is not under way is out of date
  to_process_.push_back(line_);
  if (idle) write_process();
}

void Window::write_process() {
  asio::async_write(channel_, asio::buffer(to_process_.front()),
                    [self = shared_from_this(), g = generation_](Error error, std::size_t) {
                      if (error || g != self->generation_) return;
                      self->to_process_.pop_front();
                      if (!self->to_process_.empty()) self->write_process();
                    });
}

void Window::read_process() {
  asio::async_read_until(channel_, asio::dynamic_buffer(from_process_), '\n',
                         [self = shared_from_this(), g = generation_](Error error, std::size_t size) {
                           if (g != self->generation_ || self->ended_) return;
                           if (error) return self->lost();
                           self->pass_on(self->from_process_.substr(0, size - 1));
                           self->from_process_.erase(0, size);
                           self->read_process();
                         });
}

/// The process has ended by itself: it crashed, or the machine took its memory.
void Window::lost() {
  end_process();
  start_process();
  begun_ = asked_;
  pass_on(fmt::format(R"({{"event":"error","number":{},"message":"the process that computes has ended unexpectedly",)"
                      R"("line":0,"column":0}})",
                      asked_));
}

void Window::pass_on(const std::string& line) {
  if (line.starts_with(fmt::format(R"({{"event":"begun","number":{}}})", asked_)) || line.starts_with(R"({"event":"bad")"))
    begun_ = asked_;
  std::size_t waiting = 0;
  for (const std::string& text : to_page_) waiting += text.size();
  if (waiting > kMostWaiting) return end();
  const bool idle = to_page_.empty();
  to_page_.push_back("data: " + line + "\n\n");
  if (idle) write_page();
}

void Window::write_page() {
  asio::async_write(page_, asio::buffer(to_page_.front()), [self = shared_from_this()](Error error, std::size_t) {
    if (error) return self->end();
    self->to_page_.pop_front();
    if (!self->to_page_.empty()) self->write_page();
  });
}

/// The page says nothing on this stream, but its end is seen.
void Window::watch_page() {
  page_.async_read_some(asio::buffer(unread_), [self = shared_from_this()](Error error, std::size_t) {
    if (error) return self->end();
    self->watch_page();
  });
}

void Window::beat() {
  heart_.expires_after(kHeartbeat);
  heart_.async_wait([self = shared_from_this()](Error error) {
    if (error || self->ended_) return;
    if (self->to_page_.empty()) {
      self->to_page_.push_back(": \n\n");
      self->write_page();
    }
    self->beat();
  });
}

}  // namespace corank::studio
