#include "reyes/app/relight/http_server.h"

#include <fmt/format.h>

#include <stdexcept>

#include "reyes/base/module.h"

namespace tomales {

std::unique_ptr<HttpServer> HttpServer::bind(int port) {
  using Bind = HttpServer* (*)(int);
  std::string error;
  void* const function = moduleFunction("libtomales_http.so", "tomalesBindHttpServer", error);
  if (!function)
    throw std::runtime_error(
        fmt::format("the module with the server is neither beside this program nor in ../lib/tomales: {}", error));
  return std::unique_ptr<HttpServer>(reinterpret_cast<Bind>(function)(port));
}

}  // namespace tomales
