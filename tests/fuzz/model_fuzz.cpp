// libFuzzer entry: bytes of a model through Assimp and all of `tomales import`. The first byte chooses the format.
// Assimp is the system's and has faults of its own, so crashes are counted and passed over, and their traces tell whose
// they are. Run as
//   model_fuzz -fork=1 -ignore_crashes=1 -ignore_timeouts=1 -ignore_ooms=1 -timeout=20 -rss_limit_mb=4096 WORK_FOLDER
// with seeds from `tests/fuzz/model_seeds.py WORK_FOLDER`.
#include <cstddef>
#include <cstdint>
#include <exception>
#include <fstream>

#include "reyes/base/temporary_folder.h"
#include "reyes/bindings/assimp/model_file.h"

namespace {
/// tests/fuzz/model_seeds.py has the same order.
constexpr const char* kEndings[] = {"obj", "ply", "stl", "gltf", "glb", "fbx", "dae"};
}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace tomales;
  if (size < 2) return 0;
  const char* ending = kEndings[data[0] % std::size(kEndings)];
  Log log(Log::Verbosity::Quiet);
  const TemporaryFolder scratch(std::filesystem::temp_directory_path());
  model::Settings settings;
  settings.model = (scratch.path() / "model.").string() + ending;
  settings.scene = (scratch.path() / "scene.rib").string();
  settings.parts = settings.partsByName = (scratch.path() / "parts").string();
  settings.subdivide = (data[0] & 0x80) != 0;
  std::ofstream(settings.model, std::ios::binary)
      .write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  try {
    model::importModel(settings, log);
  } catch (const std::exception&) {
    // The program would tell the user, for example that a file could not be written.
  }
  return 0;
}
