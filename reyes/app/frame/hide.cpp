#include "reyes/app/frame/hide.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

#include "reyes/app/frame/empty_frame.h"
#include "reyes/app/frame/frame_stages.h"
#include "reyes/app/frame/outputs.h"
#include "reyes/base/input_file.h"

namespace tomales {
namespace {

uint64_t sumOfFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> part(1 << 20);
  uint64_t sum = 0;
  while (file.read(part.data(), static_cast<std::streamsize>(part.size())) || file.gcount() > 0)
    sum = 31 * sum + checksum(std::as_bytes(std::span(part.data(), static_cast<size_t>(file.gcount()))));
  return sum;
}

bool isReadOnce(const std::string& file) { return file == "-" || !inputProblem(file).empty(); }

}  // namespace

std::vector<SourceFile> sourcesOf(const std::vector<std::string>& files) {
  std::vector<SourceFile> out;
  for (const std::string& file : files)
    out.push_back(isReadOnce(file) ? SourceFile{"-", 0}
                                   : SourceFile{std::filesystem::absolute(file).string(), sumOfFile(file)});
  return out;
}

void hideToFile(Scene& scene, ShaderRegistry& shaders, int world, const RenderSettings& settings, Stats& stats,
                Log& log) {
  const std::string path = withFrameNumber(settings.picture.output, scene.options.frame);
  const auto unwritten = [&](const std::string& why) {
    log.report(Severity::Output, "dfb-write", {}, "\"" + path + "\" could not be written: " + why);
  };
  if (!cropHasPixels(scene, log) || !hasFolder(path, {}, log)) return;
  const PixelRect crop = Camera(scene.options).crop();
  if (int64_t{crop.width()} * crop.height() / (int64_t{scene.options.bucketWidth} * scene.options.bucketHeight) >=
      kMostTiles)
    return unwritten("there are too many buckets; use --bucket-size or --crop");
  FrameJob job(scene, shaders, settings, stats, log);
  job.setShares(1, 1);
  job.openAll();
  job.findOpenings();
  Shot shot{scene,
            layOutFrame(scene),
            settings.picture.seed,
            sourcesOf(settings.input.files),
            std::filesystem::current_path().string(),
            world};
  std::string error;
  const auto file =
      DfbWriter::create(path, shot, settings.picture.resume ? Unfinished::Resumed : Unfinished::Kept, error);
  if (!file) return unwritten(error);
  if (settings.picture.resume)
    log.report(Severity::Info, "resume", {},
               fmt::format("{} of {} buckets were finished before", file->tilesKept(), shot.frame.tileCount()));

  std::atomic<bool> full{false};
  const TileSink sink{[&](size_t tile) { return full || file->has(tile); },
                      [&](size_t index, DeepTile&& tile) {
                        if (!file->write(index, tile)) full = true;
                      },
                      {}};
  const bool complete = hideBuckets(job, shot.frame, sink);
  if (full)
    return unwritten(file->error() + "; finished buckets are in \"" + file->unfinishedPath() +
                     "\", and --resume adds the others");
  if (!complete)
    return log.report(
        Severity::Warning, "interrupted", {},
        "interrupted: finished buckets are in \"" + file->unfinishedPath() + "\", and --resume adds the others");
  if (!file->finish()) return unwritten(file->error());
  stats.addOutput(path);
}

}  // namespace tomales
