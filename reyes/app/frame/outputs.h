// Decides which files a frame writes: the scene's Displays, as the command line changes them.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/base/plugin_trust.h"
#include "reyes/scene.h"

namespace tomales {

/// Gives a scene without Display the default one, and decides on the names of all files:
/// - `-o` takes the place of the first Display that is no map for later frames, by its type or because a Make request
///   reads it. Other pictures go beside it, so that nothing is written over that the command does not name: with
///   `-o look.exr` the Displays "m.exr" and "m_id.exr" write look.exr and look_id.exr, and "z.exr" writes look_z.exr.
///   With `--output-root` they keep their names below it.
/// - What the RIB names is written below `--output-root`.
/// - Displays that would write over an earlier one's file, and windows beside files, are left out with a message.
/// - A picture on the disk that holds more than `--crop` is kept, with a message, unless `-o` names it or `--overwrite`
///   is said: the crop of m.exr goes to m_crop.exr.
/// Throws WriteError as placeBelow() does.
void nameOutputs(Options& options, const RenderSettings& settings, Log& log);

/// Returns true if all that the frame writes is maps for later frames, such as shadow maps, which need all of their
/// view.
bool writesMapsAlone(const Options& options, const RenderSettings& settings);

/// Returns one name for the file that a Display writes, by whatever path, or for what a display driver gets.
std::string placeOf(const DisplayCall& display, const Options& options, const PluginTrust& trust);

/// Hours of rendering must not end at a folder that never existed. Returns false, and reports it, if it does not exist.
bool hasFolder(const std::string& file, const SourceLoc& where, Log& log);
/// Makes the folder only if it is relative: scenes of modellers name folders of their project. A failure shows when the
/// file is written.
void makeFolderOf(const std::string& file);
/// Makes the relative folders of Displays. Returns false, and reports it, if one of them has no folder, cannot be
/// written, or would replace the scene itself. Display drivers are not asked.
bool displaysAreWritable(const Options& options, const RenderSettings& settings, Log& log);

}  // namespace tomales
