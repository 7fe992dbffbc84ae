#include "reyes/app/relight/http_server.h"

#include <fmt/format.h>

#include <stdexcept>

#include "reyes/base/module.h"

namespace tomales {

std::unique_ptr<HttpServer> HttpServer::bind(int port) {
  static const ModuleFunction<HttpServer*(int port)> bind("libtomales_http.so", "tomalesBindHttpServer");
  if (!bind.call)
    throw std::runtime_error(
        fmt::format("the module with the server is neither beside this program nor in ../lib/tomales: {}", bind.error));
  return std::unique_ptr<HttpServer>(bind.call(port));
}

}  // namespace tomales
