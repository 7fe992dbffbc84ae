// The facts in the headers of pictures about where they come from, and the test whether a picture on the disk is that
// of a frame. OpenEXR alone has room for them (docs/displays.md).
#pragma once
#include "reyes/app/settings.h"
#include "reyes/dfb.h"
#include "reyes/scene.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// Returns a checksum of what the frame's pictures will show: of the scene, of the size and time of the files that its
/// shaders are made of and name, and of the settings that pictures depend on. Two frames with the same checksum have
/// the same pixels; the crop window is not in it. Returns an empty text if procedurals are unopened, files of light are
/// given or shaders compute names of files, because their contents are unknown.
std::string contentsOf(const Scene& scene, ShaderRegistry& shaders, const RenderSettings& settings);

/// Adds program, scene, frame, settings and, unless it is empty, contents to the headers of the frame's pictures.
void describeOutputs(Options& options, const std::string& contents, const RenderSettings& settings);
/// Makes room for statistics in the headers of the frame's pictures, if the command line asks for them. Call it where
/// the files are opened: a .dfb keeps the options, and has no statistics.
void makeRoomForStatistics(Options& options, const RenderSettings& settings);

/// Returns a checksum of what a picture of a shot depends on beside settings: its RIB files, the files of edits, and
/// `irradiance`, the checksum of the cache that it is shaded with.
std::string sumOfShot(const Shot& shot, uint64_t irradiance, const std::vector<SourceFile>& edits);
/// Returns a checksum of what gathering at a shot depends on: `sum` from sumOfShot(), and its buckets, shaders,
/// settings and crop. Returns an empty text if files of light are given, or shaders compute names of files.
std::string contentsOfGather(const Shot& shot, uint64_t buckets, ShaderRegistry& shaders, const std::string& sum,
                             const RenderSettings& settings);
void describeShot(Options& options, const std::string& sum, const RenderSettings& settings);
/// Says, in the headers of a crop, that light was gathered for this crop alone: beside another such crop there is a
/// seam.
void describeGather(Options& options, const RenderSettings& settings);
/// Adds what an audit has found to the same headers.
void describeAudit(Options& options, const std::string& sentence, const RenderSettings& settings);

/// Adds the settings of light that the program has chosen.
void describeQuality(Options& options, const std::string& chosen, const RenderSettings& settings);

/// Tells whether all files of the frame's Displays hold these contents. Formats without such headers cannot tell, which
/// is reported, and neither can display drivers.
bool isFinished(const Options& options, const std::string& contents, const RenderSettings& settings, Log& log);

}  // namespace tomales
