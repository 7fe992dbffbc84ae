#include "reyes/app/relight/relight.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "reyes/app/exit_code.h"
#include "reyes/app/frame/granted.h"
#include "reyes/app/page_files.h"
#include "reyes/app/relight/http_server.h"
#include "reyes/app/relight/pages.h"
#include "reyes/app/relight/relighting.h"
#include "reyes/app/relight/saved_edits.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/parallel.h"
#include "reyes/base/stop.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostBlocks_bytes = 3'000'000;
constexpr HttpRate kSaves{30, 1};  ///< They write files.

HttpReply jsonReply(const Json& json) {
  return {200, "application/json", json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

const char* typeOf(std::string_view file) {
  if (file.ends_with(".html")) return "text/html; charset=utf-8";
  if (file.ends_with(".css")) return "text/css; charset=utf-8";
  return "text/javascript; charset=utf-8";
}

/// Returns a number from 0 that the page sends.
uint64_t numberOf(const HttpQuestion& q, const std::string& name) {
  const auto found = q.parameters.find(name);
  const std::string text = found == q.parameters.end() ? "" : found->second;
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos)
    throw BadRequest(name + " is a number from 0");
  return std::stoull(text);
}

std::string textOf(const HttpQuestion& q, const std::string& name) {
  const auto found = q.parameters.find(name);
  return found == q.parameters.end() ? "" : found->second;
}

class RelightServer {
 public:
  RelightServer(const RelightCommand& command, const RenderSettings& settings, Stats& stats, Log& log)
      : command_(command),
        folder_(fs::temp_directory_path()),
        shot_(settings),
        log_(log),
        relighting_(fileOfShot(), stats, log),
        edits_(command.folder),
        server_(HttpServer::bind(command.port)) {}

  /// Serves the page. Returns the exit code, which later edits of a page do not affect.
  int run() {
    addRoutes();
    server_->start();
    std::printf("%s\n", server_->url().c_str());
    std::fflush(stdout);
    if (command_.opens) openBrowser();
    const End end{*this};
    const int code = hide();
    return code == kDone ? serve() : code;
  }

 private:
  /// Lets all handlers end, also if an exception ends this command: the server waits for them.
  struct End {
    RelightServer& relight;
    ~End() {
      relight.prepared_.open(false);
      relight.ended_ = true;
      relight.server_->stop();
    }
  };

  const RenderSettings& fileOfShot() {
    if (command_.hide) shot_.input.files = {(folder_.path() / "shot.dfb").string()};
    return shot_;
  }

  int hide() {
    if (!command_.hide) return kDone;
    RenderSettings hide = command_.render;
    hide.picture.output = shot_.input.files.front();
    hide.report.watcher = [this](const char* doing, float done) { relighting_.tell(doing, done); };
    const int code = command_.hide(hide);
    return fs::exists(hide.picture.output) ? kDone : code;
  }

  int serve() {
    const OrderlyEnd orderly;
    const bool isPrepared = relighting_.prepare();
    const int code = exitCodeOf(log_, shot_.report.strict);
    if (!isPrepared || stopRequested()) return code;
    relighting_.start();
    prepared_.open(true);
    while (!stopRequested() && !ended_) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ended_ = true;
    relighting_.layers().wake();
    return code;
  }

  /// Returns a handler that waits until the shot is prepared, and answers with the reason if a request is refused.
  using Answer = HttpReply (RelightServer::*)(const HttpQuestion&);
  HttpHandler later(Answer answer) {
    return [this, answer](const HttpQuestion& q) -> HttpReply {
      prepared_.pass();
      try {
        return (this->*answer)(q);
      } catch (const BadRequest& e) {
        return {400, "text/plain", e.what()};
      } catch (const Watches& e) {
        return {409, "text/plain", e.what()};
      } catch (const Json::exception&) {
        return {400, "text/plain", "this is not the JSON that is expected here"};
      }
    };
  }

  void addRoutes() {
    for (const PageFile& file : relightPage())
      server_->get(file.name == "index.html" ? "" : std::string(file.name), [file](const HttpQuestion&) {
        return HttpReply{200, typeOf(file.name), std::string(file.text)};
      });
    server_->get("preparation", [this](const HttpQuestion&) {
      Json out = relighting_.preparation();
      out["ready"] = prepared_.isOpen();
      return jsonReply(out);
    });
    server_->post("end", [this](const HttpQuestion&) {
      ended_ = true;
      if (!prepared_.isOpen() || relighting_.isGathering()) requestStop();  // as Ctrl-C does
      return jsonReply(Json::object());
    });
    const std::pair<const char*, Answer> gets[] = {
        {"scene", &RelightServer::scene}, {"offered", &RelightServer::offered}, {"shader", &RelightServer::shader},
        {"news", &RelightServer::news},   {"object", &RelightServer::object},   {"whole", &RelightServer::whole},
        {"edits", &RelightServer::edits}};
    const std::pair<const char*, Answer> posts[] = {
        {"edit", &RelightServer::edit}, {"leave", &RelightServer::leave},       {"pointer", &RelightServer::pointer},
        {"ask", &RelightServer::ask},   {"variable", &RelightServer::variable}, {"gather", &RelightServer::gather},
        {"only", &RelightServer::only}, {"load", &RelightServer::load}};
    for (const auto& [path, answer] : gets) server_->get(path, later(answer));
    for (const auto& [path, answer] : posts) server_->post(path, later(answer));
    server_->post("save", later(&RelightServer::save), kSaves);
  }

  HttpReply scene(const HttpQuestion&) { return jsonReply(relighting_.description()); }
  HttpReply offered(const HttpQuestion&) { return jsonReply(relighting_.offered()); }
  HttpReply shader(const HttpQuestion& q) {
    return jsonReply(relighting_.offeredShader(textOf(q, "kind"), textOf(q, "name")));
  }
  HttpReply object(const HttpQuestion& q) {
    return jsonReply(relighting_.objectAt(static_cast<int>(numberOf(q, "x")), static_cast<int>(numberOf(q, "y"))));
  }
  HttpReply whole(const HttpQuestion&) {
    const std::vector<float> whole = relighting_.whole();
    const auto* bytes = reinterpret_cast<const char*>(whole.data());
    return {whole.empty() ? 204 : 200, "application/octet-stream", {bytes, whole.size() * sizeof(float)}};
  }

  /// Refuses requests of a page that only watches.
  void checkEditor(const HttpQuestion& q) {
    const uint64_t page = q.parameters.contains("page") ? numberOf(q, "page") : 0;
    if (!editor_.admits(page, q.parameters.contains("take"))) throw Watches("another page edits");
  }
  HttpReply edit(const HttpQuestion& q) {
    checkEditor(q);
    relighting_.edit(Json::parse(q.body));
    relighting_.layers().wake();
    return jsonReply({{"rib", ribOf(relighting_.present(), relighting_.editable())}});
  }
  HttpReply leave(const HttpQuestion& q) {
    if (editor_.leave(numberOf(q, "page"))) relighting_.shadeOnly(std::nullopt);
    return jsonReply(Json::object());
  }
  HttpReply pointer(const HttpQuestion& q) {
    relighting_.pointAt(static_cast<int>(numberOf(q, "x")), static_cast<int>(numberOf(q, "y")));
    return jsonReply(Json::object());
  }
  HttpReply ask(const HttpQuestion&) {
    relighting_.askForWhole();
    return jsonReply(Json::object());
  }
  HttpReply variable(const HttpQuestion& q) {
    relighting_.askForVariable(textOf(q, "name"));
    return jsonReply(Json::object());
  }
  HttpReply gather(const HttpQuestion& q) {
    checkEditor(q);
    relighting_.askToGather(rectOf(q));
    relighting_.layers().wake();
    return jsonReply(Json::object());
  }
  HttpReply only(const HttpQuestion& q) {
    checkEditor(q);
    relighting_.shadeOnly(q.parameters.contains("x") ? std::optional(rectOf(q)) : std::nullopt);
    return jsonReply(Json::object());
  }

  /// Pixels of the picture, which are at least one.
  static PixelRect rectOf(const HttpQuestion& q) {
    const auto number = [&](const char* name) { return static_cast<int>(numberOf(q, name)); };
    const PixelRect out{number("x"), number("y"), number("x") + number("width"), number("y") + number("height")};
    if (out.width() < 1 || out.height() < 1) throw BadRequest("a region has a width and a height");
    return out;
  }

  /// Returns the length of the status in 32 bits, the status as JSON, and then new blocks of the layers. Without "last"
  /// these are all new blocks, reduced to fit into "bytes". With "last" they are blocks at full size, as many as fit
  /// into "bytes", up to that block.
  HttpReply news(const HttpQuestion& q) {
    uint64_t after = numberOf(q, "after");
    const size_t bytes =
        q.parameters.contains("bytes") ? std::min<size_t>(numberOf(q, "bytes"), kMostBlocks_bytes) : kMostBlocks_bytes;
    const bool full = q.parameters.contains("last");
    const LayerStore& layers = relighting_.layers();
    if (!ended_ && !full) layers.wait(after, q.parameters.contains("told") ? numberOf(q, "told") : layers.woken());
    const uint64_t told = layers.woken();  // read before the news, so that later changes are not taken for reported
    std::string blocks = full ? relighting_.layers().blocksAfter(after, bytes, numberOf(q, "last"))
                              : relighting_.layers().reducedAfter(after, bytes);
    Json status = relighting_.status();
    status["after"] = after;
    status["newest"] = relighting_.layers().newest();
    status["editor"] = editor_.page();
    status["told"] = told;
    std::string text = status.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto length = static_cast<uint32_t>(text.size());
    std::string body(reinterpret_cast<const char*>(&length), sizeof length);
    return {200, "application/octet-stream", body + text + blocks};
  }

  HttpReply edits(const HttpQuestion&) { return jsonReply(Json(edits_.names(relighting_.editable()))); }
  HttpReply save(const HttpQuestion& q) {
    const SavedEdits::Written written = edits_.save(Json::parse(q.body).at("name"), relighting_.present(),
                                                    relighting_.gatheredFile(), relighting_.editable());
    Json out = {{"file", written.edit}};
    if (!written.irradiance.empty()) out["irradiance"] = written.irradiance;
    return jsonReply(out);
  }
  HttpReply load(const HttpQuestion& q) {
    return jsonReply(jsonOf(edits_.load(Json::parse(q.body).at("name"), relighting_.editable())));
  }

  void openBrowser() const {
    if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
    const std::string command = "xdg-open '" + server_->url() + "' > /dev/null 2>&1 &";
    if (std::system(command.c_str()) != 0) return;  // the address is in the terminal
  }

  const RelightCommand& command_;
  const TemporaryFolder folder_;  ///< Holds a scene that is hidden first.
  RenderSettings shot_;
  Log& log_;
  Relighting relighting_;
  SavedEdits edits_;
  Gate prepared_;
  Editor editor_;
  std::atomic<bool> ended_{false};
  const std::unique_ptr<HttpServer> server_;  ///< The last, since its handlers use all others until it ends.
};

}  // namespace

int relightCommand(const RelightCommand& command) {
  Log log(command.render.report.verbosity);
  const RenderSettings settings = asGranted(command.render, log);
  const ThreadLimit threads(settings.resources.threads);
  Stats stats;
  try {
    return RelightServer(command, settings, stats, log).run();
  } catch (const Stopped&) {
    return kDone;
  } catch (const std::runtime_error& e) {
    log.report(Severity::Error, "relight-server", {}, e.what());
  }
  return exitCodeOf(log, settings.report.strict);
}

}  // namespace tomales
