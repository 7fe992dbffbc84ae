// A server of one page on the loopback address. It reads no file, and answers only requests of that page:
//   path    begins with the token, so that nobody is answered who does not know it
//   Host    is the address that the server listens on; otherwise a foreign host name could lead here (DNS rebinding)
//   Origin  is the page's own, if there is one
// Threads: handlers are called from several.
#pragma once
#include <functional>
#include <map>
#include <memory>
#include <string>

namespace tomales {

struct HttpReply {
  int status = 200;
  std::string type, body;
};

struct HttpQuestion {
  std::map<std::string, std::string> parameters;  ///< Those of the address, after "?".
  std::string body;
};

/// Limits of the requests to a handler; further ones get status 429.
struct HttpRate {
  double burst = 1000, perSecond = 300;
};

using HttpHandler = std::function<HttpReply(const HttpQuestion&)>;

class HttpServer {
 public:
  /// Binds to a free port, or to this one. Throws std::runtime_error if it cannot, or if the module with the library
  /// that speaks HTTP is missing.
  static std::unique_ptr<HttpServer> bind(int port);
  virtual ~HttpServer() = default;  ///< Ends as stop() does.

  /// Set the handler of a path behind the token, such as "scene". Call them before start(). A handler that throws gets
  /// status 500.
  virtual void get(const std::string& path, HttpHandler handler, const HttpRate& rate = {}) = 0;
  virtual void post(const std::string& path, HttpHandler handler, const HttpRate& rate = {}) = 0;
  /// Answers from a thread of its own until stop().
  virtual void start() = 0;
  virtual void stop() = 0;
  /// Returns the address of the page, with the token.
  virtual std::string url() const = 0;
};

}  // namespace tomales
