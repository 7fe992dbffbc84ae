// The program that `tomales import` starts: reads a model through Assimp and writes RIB. It is a process of its own
// because Assimp crashes, hangs or takes all memory on some damaged files.
#include <sys/resource.h>
#include <unistd.h>

#include <new>

#include "reyes/base/chunk_file.h"
#include "reyes/bindings/assimp/model_file.h"

namespace {

using namespace tomales;

/// Limits this process: its CPU time, and its memory to that of the machine, or to the user's own lower limits.
void limitResources(int most_s) {
  const auto limit = [](auto resource, rlim_t most) {
    rlimit now{};
    getrlimit(resource, &now);
    now.rlim_cur = std::min(now.rlim_cur, most);
    setrlimit(resource, &now);
  };
  limit(RLIMIT_CPU, static_cast<rlim_t>(most_s));
  limit(RLIMIT_CORE, 0);
#ifndef TOMALES_SANITIZED  // whose shadow memory is larger than any machine's
  limit(RLIMIT_AS, static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)));
#endif
}

}  // namespace

int main(int argc, char** argv) {
  const model::Settings settings = model::settingsOf({argv + 1, argv + argc});
  limitResources(model::mostSeconds(settings));
  Log log;
  const SourceLoc where{std::make_shared<const std::string>(settings.model), 0};
  try {
    model::importModel(settings, log);
  } catch (const WriteError& e) {
    log.report(Severity::Output, "import-write", {}, e.what());
  } catch (const std::bad_alloc&) {
    log.report(Severity::Error, "import-unreadable", where,
               "cannot be read: there is not enough memory for what it says that it holds");
  } catch (const std::exception& e) {
    log.report(Severity::Error, "import-unreadable", where, std::string("cannot be read: ") + e.what());
  }
  return model::answerOf(log.worst());
}
