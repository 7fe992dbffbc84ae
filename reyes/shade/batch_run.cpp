// A batch runs its shaders, and tells what they did wrong.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reyes/shade/batch.h"
#include "reyes/shade/illuminate.h"

namespace tomales {

void Batch::blackOutNonFinite(const BoundShader& shader) {
  running = &shader;
  const int n = points ? points->count() : tm.count;
  if (allFinite(n, view(tm.Ci)) && allFinite(n, view(tm.Oi))) return;
  for (int i = 0; i < n; ++i) {
    if (isFinite(get(tm.Ci, i)) && isFinite(get(tm.Oi, i))) continue;
    if (!isFinite(get(tm.Oi, i))) set(tm.Oi, i, vec3(1.0f));
    set(tm.Ci, i, vec3(0.0f));
  }
  report(Severity::Warning, "shader-not-finite", "returned NaN or infinity; such points are black");
}

bool Batch::run(const BoundShader& shader, const TmGrid& tmGrid) {
  TmGrid called = tmGrid;
  called.shader = shader.shader;
  return guarded(shader, [&] { shader.shader->shade(&called); });
}

std::optional<RslValue> Batch::computed(const BoundShader& shader, int param, const TmGrid& tmGrid) {
  const std::pair asked(&shader, param);
  if (std::ranges::find(computingNow_, asked) != computingNow_.end()) return std::nullopt;
  computingNow_.push_back(asked);
  RslValue out;
  const bool finished = guarded(shader, [&] { out = rslValue(*shader.shader, param, tmGrid); });
  computingNow_.pop_back();
  return finished ? std::optional(std::move(out)) : std::nullopt;
}

bool Batch::guarded(const BoundShader& shader, const std::function<void()>& call) {
  const BoundShader* caller = std::exchange(running, &shader);
  const CrashNote note(crashText());
  bool finished = true;
  const auto threw = [&](const char* what) {
    report(Severity::Missing, "shader-exception",
           fmt::format("threw an exception ({}); its result is discarded", what));
    finished = false;
  };
  try {
    call();
  } catch (const std::exception& e) {
    threw(e.what());
  } catch (...) {
    threw("of an unknown type");
  }
  running = caller;
  return finished;
}

CrashNote::Text Batch::crashText() const {
  static constexpr const char* kKinds[] = {"surface shader", "displacement shader", "light shader", "volume shader",
                                           "imager shader"};
  const SourceLoc& where = running->where;
  return {.kind = kKinds[running->shader->kind],
          .name = running->shader->name,
          .user = running->user.c_str(),
          .other = running->user == group.object ? nullptr : group.object.c_str(),
          .file = where.file ? where.file->c_str() : nullptr,
          .line = where.line};
}

void Batch::report(Severity severity, const char* code, const std::string& problem, const std::string& subject) const {
  const std::string who = running->user == group.object ? running->user : running->user + ", on " + group.object;
  scene.log.report(severity, code, running->where,
                   fmt::format("{}: shader \"{}\" {}", who, running->shader->name, problem),
                   fmt::format("{} {}", running->shader->name, subject.empty() ? problem : subject));
}

}  // namespace tomales
