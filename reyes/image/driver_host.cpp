// The program that DisplayDriver starts. It loads one display driver and passes on the requests from the socket.
#include <dlfcn.h>
#include <fmt/format.h>

#include <deque>

#include "reyes/display_api.h"
#include "reyes/image/driver_socket.h"

namespace tomales::driver {
namespace {

/// Loads the plugin. Throws what is wrong with it.
const TmDisplayDriver& load(const char* path) {
  void* handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (!handle) throw fmt::format("it cannot be loaded: {}", dlerror());
  const auto function = reinterpret_cast<TmDisplayFunction>(dlsym(handle, TM_DISPLAY_SYMBOL));
  if (!function) throw std::string("it is no display driver: it does not export " TM_DISPLAY_SYMBOL);
  const TmDisplayDriver* driver = function();
  if (!driver) throw std::string("its " TM_DISPLAY_SYMBOL "() returns NULL");
  if (driver->abi != TM_DISPLAY_ABI || driver->structBytes < sizeof(TmDisplayDriver))
    throw fmt::format(
        "it is built for display ABI {}, {} bytes; this renderer has ABI {}, {} bytes: compile it against the headers "
        "of this version",
        driver->abi, driver->structBytes, TM_DISPLAY_ABI, sizeof(TmDisplayDriver));
  if (!driver->open || !driver->rows || !driver->close) throw std::string("it lacks a function");
  return *driver;
}

template <class T>
const T* orNull(const std::vector<T>& values) {
  return values.empty() ? nullptr : values.data();
}

std::vector<const char*> textsOf(const std::vector<std::string>& texts) {
  std::vector<const char*> out;
  for (const std::string& text : texts) out.push_back(text.c_str());
  return out;
}

/// Describes a picture by the structures of the C interface.
class Picture {
 public:
  explicit Picture(BytesView bytes) {
    if (!unpack(bytes, opening_)) throw std::string("it was not understood what to open");
    channels_ = textsOf(opening_.channels);
    for (const Param& p : opening_.params) {
      const std::vector<const char*>& strings = strings_.emplace_back(textsOf(p.strings));
      const size_t count = std::max({p.floats.size(), p.ints.size(), p.strings.size()});
      params_.push_back(
          {p.name.c_str(), orNull(p.floats), orNull(p.ints), orNull(strings), static_cast<int32_t>(count), 0});
    }
    const auto& [width, height, x, y, fullWidth, fullHeight] = opening_.window;
    picture_ = {.structBytes = sizeof(TmDisplayPicture),
                .width = width,
                .height = height,
                .x = x,
                .y = y,
                .fullWidth = fullWidth,
                .fullHeight = fullHeight,
                .pixelAspect = opening_.pixelAspect,
                .channelCount = static_cast<int32_t>(channels_.size()),
                .paramCount = static_cast<int32_t>(params_.size()),
                .channels = channels_.data(),
                .params = params_.data(),
                .name = opening_.name.c_str(),
                .mode = opening_.mode.c_str(),
                .worldToCamera = {},
                .worldToScreen = {}};
    // RenderMan's matrices act on rows from the right and are stored by rows: that is glm's storage.
    std::memcpy(picture_.worldToCamera, &opening_.worldToCamera, sizeof picture_.worldToCamera);
    std::memcpy(picture_.worldToScreen, &opening_.worldToScreen, sizeof picture_.worldToScreen);
  }
  const TmDisplayPicture* get() const { return &picture_; }
  std::string unread() const {
    std::string out;
    for (const TmDisplayParam& p : params_)
      if (!p.wasRead) out += std::string(p.name) + "\n";
    return out;
  }

 private:
  Opening opening_;
  std::vector<const char*> channels_;
  std::deque<std::vector<const char*>> strings_;  // a deque, whose elements never move
  std::vector<TmDisplayParam> params_;
  TmDisplayPicture picture_;
};

class Host {
 public:
  explicit Host(const char* path) : path_(path) {}

  /// Serves a request. Returns the answer's text, and throws it as the message if something is wrong.
  std::string serve(Request request, BytesView bytes) {
    char problem[TM_DISPLAY_PROBLEM_BYTES] = "";
    const auto check = [&](bool good, const char* function) {
      problem[sizeof problem - 1] = 0;
      if (!good) throw problem[0] ? std::string(problem) : fmt::format("its {}() fails without a reason", function);
    };
    if (request == Request::Open) {
      driver_ = &load(path_);
      picture_ = std::make_unique<Picture>(bytes);
      opened_ = driver_->open(picture_->get(), problem);
      check(opened_, "open");
      return picture_->unread();
    }
    if (!opened_) return {};
    if (request == Request::Rows) {
      RowsHead head;
      std::memcpy(&head, bytes.data(), sizeof head);
      const TmDisplayRows rows{sizeof(TmDisplayRows),
                               head.x,
                               head.y,
                               head.width,
                               head.height,
                               reinterpret_cast<const float*>(bytes.data() + sizeof head)};
      check(driver_->rows(opened_, &rows, problem) == 0, "rows");
    } else {
      uint32_t complete;
      std::memcpy(&complete, bytes.data(), sizeof complete);
      check(driver_->close(std::exchange(opened_, nullptr), static_cast<int32_t>(complete), problem) == 0, "close");
    }
    return {};
  }

 private:
  const char* path_;
  const TmDisplayDriver* driver_ = nullptr;
  std::unique_ptr<Picture> picture_;
  void* opened_ = nullptr;
};

bool answer(bool good, const std::string& text) {
  const AnswerHead head{good, text.size()};
  return sendAll(kSocket, &head, sizeof head) && sendAll(kSocket, text.data(), text.size());
}

bool serveNext(Host& host) {
  RequestHead head;
  if (!receiveAll(kSocket, &head, sizeof head)) return false;
  Bytes bytes(head.bytes);
  if (!receiveAll(kSocket, bytes.data(), bytes.size())) return false;
  try {
    return answer(true, host.serve(head.request, bytes)) && head.request != Request::Close;
  } catch (const std::string& problem) {
    return answer(false, problem) && head.request != Request::Close;
  }
}

}  // namespace
}  // namespace tomales::driver

int main(int, char** arguments) {
  using namespace tomales::driver;
  close_range(kSocket + 1, ~0u, 0);  // closes the files that the renderer has open
  Host host(arguments[1]);
  while (serveNext(host)) {
  }
  _exit(0);  // close() has finished all that the driver had to do
}
