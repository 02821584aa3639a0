#include "corank/studio/server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <csignal>
#include <map>
#include <optional>

#include "corank/studio/template_models.h"
#include "corank/studio/window.h"

namespace corank::studio {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using Error = beast::error_code;

constexpr std::uint64_t kMostBody = 3 << 20;
constexpr std::uint32_t kMostHeader = 16 << 10;
constexpr std::size_t kMostConnections = 64, kMostWindows = 5;  // a browser holds six connections to one server
constexpr std::chrono::seconds kPatience{10};                   // for the rest of a request

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
    report::StudioPage page = options.page;
    for (const TemplateModel& model : template_models()) page.templates.emplace_back(model.name, model.text);
    house_.page = report::studio_page(page);
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
