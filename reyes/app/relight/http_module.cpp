// The module behind reyes/app/relight/http_server.h. The program loads it for `tomales relight` alone, because
// cpp-httplib brings OpenSSL, which would take a sixth of the time in which the program starts (docs/decisions/0033).
#include <fmt/format.h>

#include <httplib.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <optional>
#include <random>
#include <thread>

#include "reyes/app/relight/http_server.h"

namespace tomales {
namespace {

constexpr const char* kAddress = "127.0.0.1";
constexpr size_t kMostPayload_bytes = 1 << 18;
constexpr int kPatience_s = 5;
/// Number of connections that may wait to be taken. With the library's 5, those of a page that loads its parts at once,
/// or of a client that floods the port, are refused and tried again a second later.
constexpr int kMostWaiting = 128;
constexpr size_t kThreads = 16;  ///< Each page occupies one while it waits for news; others answer requests.

/// Returns 128 random bits of the system as text.
std::string newToken() {
  std::random_device random;
  std::string out;
  for (int i = 0; i < 4; ++i) out += fmt::format("{:08x}", random());
  return out;
}

/// Compares in a time that does not depend on where the texts differ.
bool sameText(const std::string& a, const std::string& b) {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned char>(a[i] ^ b[i]);
  return difference == 0;
}

/// The page may neither load from other addresses nor send to them.
const httplib::Headers kHeaders{{"Content-Security-Policy",
                                 "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
                                 "img-src 'self' data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"},
                                {"Cross-Origin-Resource-Policy", "same-origin"},
                                {"Referrer-Policy", "no-referrer"},
                                {"X-Content-Type-Options", "nosniff"},
                                {"Cache-Control", "no-store"}};

/// The requests that a rate still allows. Threads: any.
class Allowance {
 public:
  explicit Allowance(const HttpRate& rate) : rate_(rate), left_(rate.burst) {}
  bool take() {
    const std::lock_guard lock(mutex_);
    const auto now = std::chrono::steady_clock::now();
    left_ = std::min(left_ + rate_.perSecond * std::chrono::duration<double>(now - since_).count(), rate_.burst);
    since_ = now;
    if (left_ < 1) return false;
    --left_;
    return true;
  }

 private:
  const HttpRate rate_;
  std::mutex mutex_;
  double left_;
  std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};

struct Route {
  Route(HttpHandler h, const HttpRate& rate) : handler(std::move(h)), allowance(rate) {}
  const HttpHandler handler;
  Allowance allowance;
};
using Routes = std::map<std::string, std::unique_ptr<Route>>;

class ListeningServer final : public HttpServer {
 public:
  explicit ListeningServer(int port) {
    server_.new_task_queue = [] { return new httplib::ThreadPool(kThreads); };  // httplib deletes it
    server_.set_payload_max_length(kMostPayload_bytes);
    server_.set_read_timeout(kPatience_s, 0);
    server_.set_write_timeout(kPatience_s, 0);
    server_.set_keep_alive_timeout(kPatience_s);
    server_.set_tcp_nodelay(true);
    server_.set_default_headers(kHeaders);
    server_.set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
      if (isOurs(request) && pathOf(request)) return httplib::Server::HandlerResponse::Unhandled;
      response.status = 403;
      response.set_content("The address of the page, with its token, is in the terminal.\n", "text/plain");
      return httplib::Server::HandlerResponse::Handled;
    });
    server_.set_exception_handler(
        [](const httplib::Request&, httplib::Response& response, const std::exception_ptr&) { response.status = 500; });
    server_.Get(".*", [this](const httplib::Request& q, httplib::Response& a) { answer(q, a, gets_); });
    server_.Post(".*", [this](const httplib::Request& q, httplib::Response& a) { answer(q, a, posts_); });
    server_.set_socket_options([this](int socket) {  // the library's would let another process share the port
      const int on = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
      listening_ = socket;
    });
    port_ = port > 0 ? (server_.bind_to_port(kAddress, port) ? port : -1) : server_.bind_to_any_port(kAddress);
    if (port_ <= 0) throw std::runtime_error(fmt::format("no port of {} can be listened on", kAddress));
    // The library listens already, and listening again only lengthens the queue.
    ::listen(listening_, kMostWaiting);
  }
  ~ListeningServer() override { stop(); }

  void get(const std::string& path, HttpHandler handler, const HttpRate& rate) override {
    gets_[path] = std::make_unique<Route>(std::move(handler), rate);
  }
  void post(const std::string& path, HttpHandler handler, const HttpRate& rate) override {
    posts_[path] = std::make_unique<Route>(std::move(handler), rate);
  }

  void start() override {
    thread_ = std::thread([this] {
      server_.listen_after_bind();
      ended_ = true;
    });
    // A server of httplib cannot be stopped before it listens.
    while (!server_.is_running() && !ended_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  void stop() override {
    if (!thread_.joinable()) return;
    server_.stop();
    thread_.join();
  }

  std::string url() const override { return fmt::format("http://{}:{}/{}/", kAddress, port_, token_); }

 private:
  bool isOurs(const httplib::Request& request) const {
    const std::string named[] = {fmt::format("{}:{}", kAddress, port_), fmt::format("localhost:{}", port_)};
    const std::string host = request.get_header_value("Host");
    if (request.get_header_value_count("Host") != 1 || (host != named[0] && host != named[1])) return false;
    return !request.has_header("Origin") || request.get_header_value("Origin") == "http://" + host;
  }

  /// Returns the path behind the token; empty if it is not there.
  std::optional<std::string> pathOf(const httplib::Request& request) const {
    const std::string& path = request.path;
    const size_t end = token_.size() + 1;
    if (path.size() <= end || path[0] != '/' || path[end] != '/' || !sameText(path.substr(1, token_.size()), token_))
      return std::nullopt;
    return path.substr(end + 1);
  }

  void answer(const httplib::Request& request, httplib::Response& response, const Routes& routes) const {
    const auto found = routes.find(pathOf(request).value_or("?"));
    if (found == routes.end()) return void(response.status = 404);
    Route& route = *found->second;
    if (!route.allowance.take()) return void(response.status = 429);
    HttpQuestion question{{}, request.body};
    for (const auto& [name, value] : request.params) question.parameters.emplace(name, value);
    const HttpReply reply = route.handler(question);
    response.status = reply.status;
    response.set_content(reply.body, reply.type);
  }

  httplib::Server server_;
  const std::string token_ = newToken();
  int port_ = 0;
  Routes gets_, posts_;
  int listening_ = -1;  ///< The socket.
  std::thread thread_;
  std::atomic<bool> ended_{false};  ///< The thread has, or could not listen.
};

}  // namespace
}  // namespace tomales

extern "C" tomales::HttpServer* tomalesBindHttpServer(int port) { return new tomales::ListeningServer(port); }
