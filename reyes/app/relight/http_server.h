// A server of one page on the loopback address. It answers nobody who does not know the token, and no page of another
// origin: each request's path begins with the token, Host is the address that the server listens on (else a name of
// somebody else could be made to lead here: DNS rebinding), and Origin, if there is one, is the page's own. No file is
// read. Threads: handlers are called from several.
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
  /// Binds to a free port, or to this one. Throws std::runtime_error if it cannot.
  explicit HttpServer(int port);
  ~HttpServer();  ///< Ends as stop() does.

  /// Set the handler of a path behind the token, such as "scene". Call them before start().
  void get(const std::string& path, HttpHandler handler, const HttpRate& rate = {});
  void post(const std::string& path, HttpHandler handler, const HttpRate& rate = {});
  /// Answers from a thread of its own until stop().
  void start();
  void stop();
  /// Returns the address of the page, with the token.
  std::string url() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
