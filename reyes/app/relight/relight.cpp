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
#include "reyes/app/relight/relighting.h"
#include "reyes/app/watch/interrupt.h"
#include "reyes/base/parallel.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEdit = ".rib";
constexpr size_t kLongestName = 64, kMostBlocks_bytes = size_t{3} << 20;

HttpReply jsonReply(const Json& json) {
  return {200, "application/json", json.dump(-1, ' ', false, Json::error_handler_t::replace)};
}

const char* typeOf(std::string_view file) {
  if (file.ends_with(".html")) return "text/html; charset=utf-8";
  if (file.ends_with(".css")) return "text/css; charset=utf-8";
  return "text/javascript; charset=utf-8";
}

/// A number from 0 that the page sends.
uint64_t numberOf(const HttpQuestion& q, const std::string& name) {
  const auto found = q.parameters.find(name);
  const std::string text = found == q.parameters.end() ? "" : found->second;
  if (text.empty() || text.size() > 9 || text.find_first_not_of("0123456789") != std::string::npos)
    throw BadRequest(name + " is a number from 0");
  return std::stoull(text);
}

/// The file of an edit in the folder. Only letters, digits, - and _ make a name, so that it leads nowhere else.
fs::path fileOfEdit(const std::string& folder, const std::string& name) {
  const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; };
  if (name.empty() || name.size() > kLongestName || !std::ranges::all_of(name, plain))
    throw BadRequest("a name has up to 64 letters, digits, - and _");
  return fs::path(folder) / (name + kEdit);
}

/// The page that edits, by the number that it has given itself; others watch. Threads: any.
class Editor {
 public:
  /// Tells whether this page may edit: it does already, it takes over, or nobody does. Page 0 has no number.
  bool admits(uint64_t page, bool takesOver) {
    uint64_t nobody = 0;
    if (takesOver)
      page_ = page;
    else
      page_.compare_exchange_strong(nobody, page);
    return page_ == page;
  }
  void leave(uint64_t page) { page_.compare_exchange_strong(page, 0); }
  uint64_t page() const { return page_; }

 private:
  std::atomic<uint64_t> page_{0};
};

class Relight {
 public:
  Relight(const RelightCommand& command, const RenderSettings& settings, Stats& stats, Log& log)
      : command_(command), log_(log), relighting_(settings, stats, log), server_(command.port) {}

  void run() {
    if (!relighting_.prepare() || interrupted()) return;
    addRoutes();
    relighting_.start();
    server_.start();
    std::printf("%s\n", server_.url().c_str());
    std::fflush(stdout);
    if (command_.opens) openBrowser();
    while (!interrupted() && !ended_) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    ended_ = true;
    relighting_.layers().wake();
    server_.stop();
  }

 private:
  void addRoutes() {
    for (const PageFile& file : relightPage())
      server_.get(file.name == "index.html" ? "" : std::string(file.name), [file](const HttpQuestion&) {
        return HttpReply{200, typeOf(file.name), std::string(file.text)};
      });
    server_.get("scene", [this](const HttpQuestion&) { return jsonReply(relighting_.description()); });
    server_.get("news", [this](const HttpQuestion& q) { return news(q); });
    server_.get("object", [this](const HttpQuestion& q) {
      return jsonReply(relighting_.objectAt(static_cast<int>(numberOf(q, "x")), static_cast<int>(numberOf(q, "y"))));
    });
    server_.get("whole", [this](const HttpQuestion&) {
      const std::vector<float> whole = relighting_.whole();
      const auto* bytes = reinterpret_cast<const char*>(whole.data());
      return HttpReply{whole.empty() ? 204 : 200, "application/octet-stream", {bytes, whole.size() * sizeof(float)}};
    });
    server_.get("edits", [this](const HttpQuestion&) { return jsonReply(savedEdits()); });
    server_.post("edit", [this](const HttpQuestion& q) {
      const uint64_t page = q.parameters.contains("page") ? numberOf(q, "page") : 0;
      if (!editor_.admits(page, q.parameters.contains("take")))
        return HttpReply{409, "text/plain", "another page edits"};
      relighting_.edit(Json::parse(q.body));
      relighting_.layers().wake();
      return jsonReply({{"rib", ribOf(relighting_.present(), relighting_.editable())}});
    });
    server_.post("leave", [this](const HttpQuestion& q) {
      editor_.leave(numberOf(q, "page"));
      return jsonReply(Json::object());
    });
    server_.post("pointer", [this](const HttpQuestion& q) {
      relighting_.pointAt(static_cast<int>(numberOf(q, "x")), static_cast<int>(numberOf(q, "y")));
      return jsonReply(Json::object());
    });
    server_.post("ask", [this](const HttpQuestion&) {
      relighting_.askForWhole();
      return jsonReply(Json::object());
    });
    server_.post("save", [this](const HttpQuestion& q) { return save(Json::parse(q.body).at("name")); });
    server_.post("load", [this](const HttpQuestion& q) {
      const fs::path file = fileOfEdit(command_.folder, Json::parse(q.body).at("name"));
      if (!fs::is_regular_file(file)) throw BadRequest("there is no such edit");
      return jsonReply(jsonOf(stateOfRib(file.string(), relighting_.editable(), log_)));
    });
    server_.post("end", [this](const HttpQuestion&) {
      ended_ = true;
      return jsonReply(Json::object());
    });
  }

  /// The status as JSON after its length in 32 bits, and new blocks of the layers.
  HttpReply news(const HttpQuestion& q) {
    uint64_t after = numberOf(q, "after");
    if (!ended_) relighting_.layers().wait(after);
    std::string blocks = relighting_.layers().blocksAfter(after, kMostBlocks_bytes);
    Json status = relighting_.status();
    status["after"] = after;
    status["editor"] = editor_.page();
    std::string text = status.dump(-1, ' ', false, Json::error_handler_t::replace);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto length = static_cast<uint32_t>(text.size());
    std::string body(reinterpret_cast<const char*>(&length), sizeof length);
    return {200, "application/octet-stream", body + text + blocks};
  }

  Json savedEdits() const {
    Json out = Json::array();
    std::error_code failed;  // then there are none
    for (const fs::directory_entry& entry : fs::directory_iterator(command_.folder, failed))
      if (entry.path().extension() == kEdit) out.push_back(entry.path().stem().string());
    std::sort(out.begin(), out.end());
    return out;
  }

  HttpReply save(const std::string& name) {
    const fs::path file = fileOfEdit(command_.folder, name);
    std::string error;
    if (!writeFile(file.string(), ribOf(relighting_.present(), relighting_.editable()), error))
      throw BadRequest(file.string() + " could not be written: " + error);
    return jsonReply({{"file", file.string()}});
  }

  void openBrowser() const {
    if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY")) return;
    const std::string command = "xdg-open '" + server_.url() + "' > /dev/null 2>&1 &";
    if (std::system(command.c_str()) != 0) return;  // the address is in the terminal
  }

  const RelightCommand& command_;
  Log& log_;
  Relighting relighting_;
  HttpServer server_;
  Editor editor_;
  std::atomic<bool> ended_{false};
};

}  // namespace

int relightCommand(const RelightCommand& command) {
  const OrderlyEnd orderly;
  Log log(command.render.verbosity);
  const RenderSettings settings = asGranted(command.render, log);
  const ThreadLimit threads(settings.threads);
  Stats stats;
  try {
    Relight(command, settings, stats, log).run();
  } catch (const std::runtime_error& e) {
    log.report(Severity::Error, "relight-server", {}, e.what());
  }
  return exitCodeOf(log, settings.strict);
}

}  // namespace tomales
