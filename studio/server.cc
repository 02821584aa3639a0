#include "corank/studio/server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <csignal>
#include <deque>
#include <map>
#include <optional>

#include "corank/studio/worker.h"

namespace corank::studio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using Channel = asio::local::stream_protocol::socket;
using Error = beast::error_code;

constexpr std::uint64_t kMostBody = 3 << 20;
constexpr std::uint32_t kMostHeader = 16 << 10;
constexpr std::size_t kMostConnections = 64, kMostWindows = 5;  // a browser holds six connections to one server
constexpr std::size_t kMostWaiting = 256 << 20;                 // bytes for a window that does not read
constexpr std::chrono::seconds kPatience{10};                   // for the rest of a request
constexpr std::chrono::milliseconds kGrace{700};                // for an answer to end; GiNaC does not look at a flag
constexpr std::chrono::seconds kHeartbeat{15};

std::string random_token() {
  std::array<std::uint8_t, 16> bytes;
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw ServerError("no random bytes for a token");
  std::string token;
  for (const std::uint8_t b : bytes) token += fmt::format("{:02x}", b);
  return token;
}

/// In a time that does not tell where they differ.
bool same(const std::string& a, const std::string& b) {
  unsigned char differ = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i)
    differ |= static_cast<unsigned char>(a[i] ^ b[i % std::max<std::size_t>(b.size(), 1)]);
  return differ == 0;
}

struct Target {
  std::string path;
  std::map<std::string, std::string> query;

  explicit Target(std::string_view text) {
    const std::size_t mark = std::min(text.find('?'), text.size());
    path = text.substr(0, mark);
    for (std::size_t at = mark + 1; at < text.size();) {
      const std::size_t end = std::min(text.find('&', at), text.size()), equals = std::min(text.find('=', at), end);
      query.emplace(text.substr(at, equals - at), text.substr(std::min(equals + 1, end), end - std::min(equals + 1, end)));
      at = end + 1;
    }
  }
  std::string at(const std::string& name) const {
    const auto found = query.find(name);
    return found == query.end() ? "" : found->second;
  }
};

/// Letters and digits, at most 40.
bool is_plain(const std::string& text) {
  return !text.empty() && text.size() <= 40 &&
         std::ranges::all_of(text, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; });
}

/// A window's process, and the stream on which its lines go to the page. Ends with the stream.
class Window : public std::enable_shared_from_this<Window> {
 public:
  Window(asio::io_context& context, tcp::socket page, SessionLimits limits, std::function<void()> on_end)
      : context_(context),
        page_(std::move(page)),
        channel_(context),
        timer_(context),
        heart_(context),
        limits_(limits),
        on_end_(std::move(on_end)) {}
  ~Window() { end_process(); }

  void start() {
    to_page_.push_back(
        "HTTP/1.1 200 OK\r\nContent-Type: text/event-stream\r\nCache-Control: no-store\r\nConnection: close\r\n"
        "X-Content-Type-Options: nosniff\r\n\r\n: corank studio\n\n");
    write_page();
    watch_page();
    beat();
    start_process();
  }

  void ask(std::uint64_t number, std::string line) {
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

  void end() {
    if (ended_) return;
    ended_ = true;
    timer_.cancel();
    heart_.cancel();
    Error ignored;
    page_.close(ignored);
    end_process();
    on_end_();
  }

 private:
  void start_process() {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) return end();
    context_.notify_fork(asio::io_context::fork_prepare);
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(ends[1], 3);
      ::close_range(4, ~0U, 0);
      std::signal(SIGINT, SIG_IGN);
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

  void end_process() {
    Error ignored;
    channel_.close(ignored);
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
    process_ = -1;
  }

  void send_request() {
    const bool idle = to_process_.empty();
    to_process_.resize(std::min<std::size_t>(to_process_.size(), 1));  // what is not under way is out of date
    to_process_.push_back(line_);
    if (idle) write_process();
  }

  void write_process() {
    asio::async_write(channel_, asio::buffer(to_process_.front()),
                      [self = shared_from_this(), g = generation_](Error error, std::size_t) {
                        if (error || g != self->generation_) return;
                        self->to_process_.pop_front();
                        if (!self->to_process_.empty()) self->write_process();
                      });
  }

  void read_process() {
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
  void lost() {
    end_process();
    start_process();
    begun_ = asked_;
    pass_on(fmt::format(R"({{"event":"error","number":{},"message":"the process that computes has ended unexpectedly",)"
                        R"("line":0,"column":0}})",
                        asked_));
  }

  void pass_on(const std::string& line) {
    if (line.starts_with(fmt::format(R"({{"event":"begun","number":{}}})", asked_)) || line.starts_with(R"({"event":"bad")"))
      begun_ = asked_;
    std::size_t waiting = 0;
    for (const std::string& text : to_page_) waiting += text.size();
    if (waiting > kMostWaiting) return end();
    const bool idle = to_page_.empty();
    to_page_.push_back("data: " + line + "\n\n");
    if (idle) write_page();
  }

  void write_page() {
    asio::async_write(page_, asio::buffer(to_page_.front()), [self = shared_from_this()](Error error, std::size_t) {
      if (error) return self->end();
      self->to_page_.pop_front();
      if (!self->to_page_.empty()) self->write_page();
    });
  }

  /// The page says nothing on this stream, but its end is seen.
  void watch_page() {
    page_.async_read_some(asio::buffer(unread_), [self = shared_from_this()](Error error, std::size_t) {
      if (error) return self->end();
      self->watch_page();
    });
  }

  void beat() {
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

  asio::io_context& context_;
  tcp::socket page_;
  Channel channel_;
  asio::steady_timer timer_, heart_;
  const SessionLimits limits_;
  const std::function<void()> on_end_;
  pid_t process_ = -1;
  int generation_ = 0;
  bool ended_ = false;
  std::uint64_t asked_ = 0, begun_ = 0;
  std::string line_, from_process_;
  std::deque<std::string> to_process_, to_page_;
  std::array<char, 256> unread_{};
};

/// What all connections share.
struct House {
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  std::string token, host, page;
  SessionLimits limits;
  std::map<std::string, std::weak_ptr<Window>> windows;  // by client
  std::size_t connections = 0;
};

/// One connection: request after request, until it is closed or becomes a window's stream.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(House& house, tcp::socket socket) : house_(house), stream_(std::move(socket)) { ++house_.connections; }
  ~Connection() { --house_.connections; }

  void read() {
    parser_.emplace();
    parser_->header_limit(kMostHeader);
    parser_->body_limit(kMostBody);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, *parser_, [self = shared_from_this()](Error error, std::size_t) {
      if (error == http::error::end_of_stream) return self->close();
      if (error == http::error::body_limit)
        return self->say(http::status::payload_too_large, "the request is too long", true);
      if (error.category() == http::make_error_code(http::error::end_of_stream).category() &&
          error != http::error::partial_message)
        return self->say(http::status::bad_request, "this is no HTTP request", true);
      if (!error) self->answer();
    });
  }

 private:
  using Request = http::request<http::string_body>;

  static std::string header(const Request& request, http::field field) { return std::string(request[field]); }

  void answer() {
    const Request& request = parser_->get();
    const Target target(std::string(request.target()));
    const std::string host = header(request, http::field::host), origin = header(request, http::field::origin);
    const std::string port = house_.host.substr(house_.host.find(':'));
    if (host != house_.host && host != "localhost" + port) return say(http::status::forbidden, "another host");
    if (!origin.empty() && origin != "http://" + host) return say(http::status::forbidden, "another origin");
    if (request["Sec-Fetch-Site"] == "cross-site" && target.path != "/") return say(http::status::forbidden, "another site");
    if (target.path == "/favicon.ico") return say(http::status::no_content, "");
    if (!same(target.at("token"), house_.token))
      return say(http::status::forbidden,
                 "The address has no token, or one of another run: take the one that corank studio prints.");
    const bool get = request.method() == http::verb::get;
    if (!get && request.method() != http::verb::post) return say(http::status::method_not_allowed, "another method", true);
    if (target.path == "/" && get) return say(http::status::ok, house_.page, false, "text/html; charset=utf-8");
    const std::string client = target.at("client");
    if ((target.path != "/events" && target.path != "/ask") || !is_plain(client))
      return say(http::status::not_found, "there is no such page");
    if (target.path == "/events" && get) return open_window(client);
    if (target.path == "/ask" && request.method() == http::verb::post) return ask(client, target.at("number"));
    say(http::status::method_not_allowed, "another method", true);
  }

  void open_window(const std::string& client) {
    std::erase_if(house_.windows, [](const auto& entry) { return entry.second.expired(); });
    if (house_.windows.contains(client)) return say(http::status::conflict, "this window is open already");
    if (house_.windows.size() >= kMostWindows)
      return say(http::status::service_unavailable, "too many windows show the studio: close one");
    stream_.expires_never();
    const auto window = std::make_shared<Window>(house_.context, stream_.release_socket(), house_.limits,
                                                 [&house = house_, client] { house.windows.erase(client); });
    house_.windows[client] = window;
    window->start();
  }

  void ask(const std::string& client, const std::string& number) {
    const auto at = house_.windows.find(client);
    const std::shared_ptr<Window> window = at == house_.windows.end() ? nullptr : at->second.lock();
    if (!window) return say(http::status::conflict, "no such window is open");
    if (!is_plain(number) || number.size() > 15 || number.find_first_not_of("0123456789") != std::string::npos)
      return say(http::status::bad_request, "the request has no number");
    std::string line = std::move(parser_->get().body());
    std::ranges::replace_if(
        line, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    window->ask(std::stoull(number), line + '\n');
    say(http::status::no_content, "");
  }

  void say(http::status status, std::string text, bool last = false, const char* type = "text/plain; charset=utf-8") {
    response_ = {};
    response_.result(status);
    response_.version(11);
    response_.keep_alive(!last && parser_->keep_alive());
    response_.set(http::field::content_type, type);
    response_.set(http::field::cache_control, "no-store");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set("Content-Security-Policy",
                  "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; "
                  "connect-src 'self'; base-uri 'none'; form-action 'none'; "
                  "frame-ancestors http://localhost:* http://127.0.0.1:*");
    response_.body() = std::move(text);
    response_.prepare_payload();
    stream_.expires_after(kPatience);
    http::async_write(stream_, response_, [self = shared_from_this()](Error error, std::size_t) {
      if (error || !self->response_.keep_alive()) return self->close();
      self->read();
    });
  }

  void close() {
    Error ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
  }

  House& house_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_{kMostHeader + kMostBody};
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
};

void accept(House& house) {
  house.acceptor.async_accept([&house](Error error, tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error && house.connections < kMostConnections) {
      Error ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      std::make_shared<Connection>(house, std::move(socket))->read();
    }
    accept(house);
  });
}

}  // namespace

class Server::Impl {
 public:
  explicit Impl(const ServerOptions& options) {
    house_.token = random_token();
    house_.limits = options.limits;
    const tcp::endpoint place(asio::ip::address_v4::loopback(), options.port);
    try {
      house_.acceptor.open(place.protocol());
      house_.acceptor.set_option(tcp::acceptor::reuse_address(true));
      house_.acceptor.bind(place);
      house_.acceptor.listen();
    } catch (const boost::system::system_error& error) {
      throw ServerError(fmt::format("port {}: {}", options.port, error.code().message()));
    }
    ::fcntl(house_.acceptor.native_handle(), F_SETFD, FD_CLOEXEC);
    house_.host = fmt::format("127.0.0.1:{}", house_.acceptor.local_endpoint().port());
    house_.page = options.page();
  }

  std::string address() const { return fmt::format("http://{}/?token={}", house_.host, house_.token); }

  void run() {
    asio::signal_set signals(house_.context, SIGINT, SIGTERM);
    signals.async_wait([this](Error, int) {
      for (const auto& [client, window] : std::map(house_.windows))
        if (const auto open = window.lock()) open->end();
      house_.context.stop();
    });
    accept(house_);
    house_.context.run();
  }

 private:
  House house_;
};

Server::Server(ServerOptions options) : impl_(std::make_unique<Impl>(options)) {}
Server::~Server() = default;
std::string Server::address() const { return impl_->address(); }
void Server::run() { impl_->run(); }

}  // namespace corank::studio
