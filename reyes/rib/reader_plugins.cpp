// Procedural "DynamicLoad". Calls of a plugin are recorded first and read after it has returned. So its code runs
// alone, ours need not be reentrant, and calls before a failure are kept.
#include <fmt/format.h>

#include "reyes/base/crash_note.h"
#include "reyes/base/search_path.h"
#include "reyes/rib/reader.h"

namespace tomales::rib {
namespace {

constexpr size_t kPluginCost = 10;

}  // namespace

void Reader::dynamicLoad(const Request& r) {
  const std::vector<std::string>& call = r.args[1].strings;
  const std::string path = pluginFile(r, call[0]);
  tellOfFile(r, "plugin", call[0], path);
  if (path.empty()) return;
  const Plugin& plugin = plugins_->load(path);
  if (!plugin.trouble.empty()) return missingPlugin(r, call[0], plugin.trouble);
  std::string text = call.size() > 1 ? call[1] : "";
  callPlugin(r, call[0], [&](float detail) {
    const std::unique_ptr<void, void (*)(RtPointer)> data(plugin.convertParameters(text.data()), plugin.free);
    plugin.subdivide(data.get(), detail);
  });
}

std::string Reader::pluginFile(const Request& r, const std::string& name) const {
  const std::string files[] = {name, name + ".so"};
  for (const std::string& file : files)
    if (const auto trusted = filesWithin(settings_.trust.pluginFolders(), file); !trusted.empty())
      return trusted.front();
  for (const std::string& file : files) {
    std::string path = findFile(file, "procedural");
    if (path.empty()) continue;
    if (settings_.trust.allowsPluginsOfScene()) return path;
    missingPlugin(r, path, kPluginRefusal);
    return {};
  }
  missingPlugin(r, name, "is not found (--plugin-path, Option \"searchpath\" \"procedural\")");
  return {};
}

void Reader::missingPlugin(const Request& r, const std::string& name, const std::string& why) const {
  report(Severity::Missing, "rib-plugin", r,
         fmt::format("plugin \"{}\" {}; nothing is drawn in its place", name.substr(0, 200), why));
}

void Reader::callPlugin(const Request& r, const std::string& name, const std::function<void(float)>& subdivide) {
  const std::string key = fmt::format("{}: plugin {}", open_.size(), name);
  if (!mayEnter(r, key, kPluginCost)) return;
  const std::vector<float>& bound = r.args[2].numbers;
  const float detail = bound.size() == 6 ? builder_.rasterArea(bound) : kInfinity;
  const SceneBuilder::LocalState place = builder_.place();
  std::vector<RiCall> calls;
  std::string trouble;
  try {
    const std::lock_guard alone(pluginMutex());
    const CrashNote note(
        {"plugin", name.c_str(), "Procedural", nullptr, r.where.file ? r.where.file->c_str() : nullptr, r.where.line});
    recordRiCalls(
        {dictionary_, place.scope.uBasis.step, place.scope.vBasis.step, r.where}, log_, [&] { subdivide(detail); },
        calls);
  } catch (const std::exception& e) {
    trouble = fmt::format("failed: {}", e.what());
  } catch (...) {
    trouble = "failed";
  }
  performBlock("AttributeBegin", r.where);
  enter(key, std::string(open_.back().folder));
  for (const RiCall& call : calls) {
    if (!spend(1)) break;
    takeCall(call);
  }
  leave();
  performBlock("AttributeEnd", r.where);
  if (!trouble.empty())
    report(Severity::Missing, "rib-plugin", r,
           fmt::format("plugin \"{}\" {}; what it called before is used", name.substr(0, 200), trouble));
  else if (calls.empty())
    report(Severity::Warning, "rib-plugin", r, fmt::format("plugin \"{}\" called nothing", name.substr(0, 200)));
}

void Reader::takeCall(const RiCall& call) {
  if (!call.procedural) return handle(dictionary_.hasColorSamples() ? withRgb(call.request) : call.request);
  later(call.request, [r = call.request, own = *call.procedural](Reader& reader) {
    reader.callPlugin(r, r.args[0].strings[0], [&own](float detail) { own.subdivide(own.data.get(), detail); });
  });
}

}  // namespace tomales::rib
