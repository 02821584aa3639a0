// The studio's server: one page on 127.0.0.1, behind a random token. Each window that shows it has a process of its own that
// computes (worker.h), which ends with the window.
//
//   studio::Server server({.page = {.file = "dextar.cuik", .text = text}});
//   std::puts(server.address().c_str());  // http://127.0.0.1:41999/?token=…
//   server.run();
//
//   GET  /?token=T                            the page
//   GET  /events?token=T&client=C             the lines of answers, as server-sent events
//   POST /ask?token=T&client=C&number=N       a request (request.h), which ends the one before
//
// All else is refused: another host or origin, a wrong token, bodies over 3 MB. Nothing in a request names a file.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "corank/report/html/live_page.h"
#include "corank/studio/session.h"

namespace corank::studio {

/// It cannot listen. what() is one line.
class ServerError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ServerOptions {
  std::uint16_t port = 0;     ///< 0: any that is free
  report::StudioPage page{};  ///< without its templates
  SessionLimits limits{};
};

class Server {
 public:
  /// Listens from now on. Throws ServerError.
  explicit Server(ServerOptions options);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// With the token.
  std::string address() const;
  /// Serves until SIGINT or SIGTERM, then ends what it runs. The process must have no other thread, nor have used GiNaC.
  void run();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace corank::studio
