// A window that shows the studio: its process that computes, and the stream on which that one's lines go to the page.
//
// The process is a copy of this one (worker.h). It is ended where an answer goes on for a while after a newer request came:
// GiNaC does not look at a flag. Then, and where it crashes, another takes its place.
#pragma once

// clang-format off
#include <utility>  // which Boost 1.74 needs and does not include
// clang-format on
#include <array>
#include <boost/asio.hpp>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "corank/studio/session.h"

namespace corank::studio {

class Window : public std::enable_shared_from_this<Window> {
 public:
  using Socket = boost::asio::ip::tcp::socket;

  /// `page`: the connection of a request for events that is to be answered. `on_end` is called once, where the page is gone.
  Window(boost::asio::io_context& context, Socket page, SessionLimits limits, std::function<void()> on_end);
  ~Window();

  void start();
  /// `line`: a request with this number, and its end of line. Ends the answer to the one before.
  void ask(std::uint64_t number, std::string line);
  /// Ends the process, and the stream.
  void end();

 private:
  using Channel = boost::asio::local::stream_protocol::socket;

  void start_process();
  void end_process();
  void send_request();
  void write_process();
  void read_process();
  void lost();
  void pass_on(const std::string& line);
  void write_page();
  void watch_page();
  void beat();

  boost::asio::io_context& context_;
  Socket page_;
  Channel channel_;
  boost::asio::steady_timer timer_, heart_;
  const SessionLimits limits_;
  const std::function<void()> on_end_;
  pid_t process_ = -1;
  int generation_ = 0;  // of the process: what belongs to a former one is passed over
  bool ended_ = false;
  std::uint64_t asked_ = 0, begun_ = 0;
  std::string line_, from_process_;
  std::deque<std::string> to_process_, to_page_;
  std::array<char, 256> unread_{};
};

}  // namespace corank::studio
