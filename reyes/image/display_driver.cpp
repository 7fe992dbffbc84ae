#include "reyes/display_driver.h"

#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>

#include <cstring>
#include <mutex>

#include "reyes/base/child_process.h"
#include "reyes/base/process.h"
#include "reyes/base/stop.h"
#include "reyes/image/driver_socket.h"

namespace tomales {

using namespace driver;

namespace {

constexpr int kPatience_s = 5;  ///< Longest wait for a driver that does not answer, once the program has to end.

/// Waits for data from the other side. Returns false if it takes too long.
bool arrives(int socket) {
  constexpr int kTurn_ms = 100;
  for (int waited_ms = 0; waited_ms < 1000 * kPatience_s;) {
    pollfd wait{socket, POLLIN, 0};
    if (::poll(&wait, 1, kTurn_ms) > 0) return true;
    if (stopRequested()) waited_ms += kTurn_ms;
  }
  return false;
}

}  // namespace

std::string suppliedDriver(const std::string& type) {
  if (leavesFolders(type)) return {};
  const auto files = besideProgram("tomales_displays/" + type + ".so");
  return files.empty() ? std::string() : files.front().string();
}

struct DisplayDriver::Impl {
  explicit Impl(const std::string& plugin) : name(plugin) {
    if (const std::string why = start(); !why.empty()) fail(why);
  }
  ~Impl() { end(); }

  /// Returns what is wrong, or an empty text.
  std::string start() {
    const auto programs = besideProgram("tomales_display_host");
    if (programs.empty()) return "the program tomales_display_host is not beside this one";
    int ends[2], why = 0;
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return std::strerror(errno);
    const std::string program = programs.front();
    child = startChild({program, {program, name}, {{ends[1], kSocket}}}, why);
    ::close(ends[1]);
    socket = ends[0];
    if (child < 0) return fmt::format("{} cannot be started: {}", program, std::strerror(why));
    guard.emplace(child);
    return {};
  }

  void fail(const std::string& why) {
    if (!hasFailed) problem = why;
    hasFailed = true;
  }

  /// Sends a request and takes the answer.
  bool ask(Request request, std::initializer_list<BytesView> parts, std::string& text) {
    if (hasFailed) return false;
    uint64_t bytes = 0;
    for (const BytesView part : parts) bytes += part.size();
    const RequestHead head{request, bytes};
    bool lives = sendAll(socket, &head, sizeof head);
    for (const BytesView part : parts) lives = lives && sendAll(socket, part.data(), part.size());
    AnswerHead answer{};
    if (lives && !arrives(socket)) {
      fail(fmt::format("display driver {} does not answer for {} s", name, kPatience_s));
      abandon();
      return false;
    }
    lives = lives && receiveAll(socket, &answer, sizeof answer);
    text.resize(lives ? answer.bytes : 0);
    lives = lives && receiveAll(socket, text.data(), text.size());
    if (!lives)
      fail(fateOf(end()));
    else if (!answer.good)
      fail(fmt::format("display driver {}: {}", name, text));
    return !hasFailed;
  }

  std::string fateOf(int status) const {
    if (WIFSIGNALED(status)) return fmt::format("display driver {} crashes ({})", name, strsignal(WTERMSIG(status)));
    return fmt::format("display driver {} ends its process", name);
  }

  void abandon() {
    const std::lock_guard lock(mutex);
    if (child > 0) ::kill(child, SIGKILL);
  }

  /// Returns the status of the process, which ends when its socket is closed.
  int end() {
    if (socket >= 0) ::close(std::exchange(socket, -1));
    const std::lock_guard lock(mutex);
    if (child < 0) return 0;
    guard.reset();
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    child = -1;
    return status;
  }

  const std::string name;
  std::mutex mutex;  // protects `child`
  pid_t child = -1;
  std::optional<ChildGuard> guard;
  int socket = -1;
  bool hasFailed = false, isOpen = false;
  std::string problem;
  std::vector<std::string> unread;
};

DisplayDriver::DisplayDriver(const std::string& plugin, const DriverPicture& p) : impl_(new Impl(plugin)) {
  const Opening opening{p.name,
                        p.mode,
                        {p.width, p.height, p.x, p.y, p.fullWidth, p.fullHeight},
                        p.pixelAspect,
                        p.channels,
                        p.params,
                        p.view.cameraFromWorld,
                        p.view.screenFromWorld};
  std::string unread;
  impl_->isOpen = impl_->ask(Request::Open, {pack(opening)}, unread);
  if (impl_->isOpen)
    for (size_t at = 0, end; (end = unread.find('\n', at)) != std::string::npos; at = end + 1)
      impl_->unread.push_back(unread.substr(at, end - at));
}

DisplayDriver::~DisplayDriver() {
  if (impl_->isOpen && impl_->socket >= 0) {
    impl_->hasFailed = false;  // the driver may still keep what it has
    const uint32_t complete = 0;
    std::string text;
    impl_->ask(Request::Close, {std::as_bytes(std::span(&complete, 1))}, text);
  }
}

bool DisplayDriver::write(const Image& rows) {
  const RowsHead head{rows.originX, rows.originY, rows.width, rows.height};
  std::string text;
  return impl_->ask(Request::Rows, {std::as_bytes(std::span(&head, 1)), std::as_bytes(std::span(rows.pixels))}, text);
}

bool DisplayDriver::close() {
  const uint32_t complete = 1;
  std::string text;
  impl_->isOpen = false;
  return impl_->ask(Request::Close, {std::as_bytes(std::span(&complete, 1))}, text);
}

void DisplayDriver::abandon() { impl_->abandon(); }
bool DisplayDriver::failed() const { return impl_->hasFailed; }
const std::string& DisplayDriver::error() const { return impl_->problem; }
const std::vector<std::string>& DisplayDriver::unread() const { return impl_->unread; }

}  // namespace tomales
