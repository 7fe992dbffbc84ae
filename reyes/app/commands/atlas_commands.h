// tomales photons, irradiance, brickmake, view, convert: the irradiance atlas pass by pass (docs/gi.md).
#pragma once
#include <functional>

#include "reyes/app/settings.h"

namespace tomales {

/// Traces InputSettings::files to photon maps in PictureSettings::output, one file for each group.
int photonsCommand(const RenderSettings& settings);

struct IrradianceCommand {
  std::vector<std::string> inputs;  ///< Photon maps, or folders of them.
  std::string output;               ///< A folder.
  PhotonIrradianceSettings settings;
};
int irradianceCommand(const IrradianceCommand& command);

struct BrickmakeCommand {
  std::vector<std::string> inputs;  ///< Point clouds, or folders of them.
  std::string output;               ///< FILE.bkm for all inputs, or a folder of one for each.
  BrickSettings settings;
  bool relative = false;  ///< maxError is a share of the mean of the data.
  bool oneFile = false;   ///< True if `output` is a file, whatever its ending is.
};
/// Calls `made` with each map. Throws FileError, or std::filesystem::filesystem_error.
void makeBrickMaps(const BrickmakeCommand& command, const std::function<void(const std::string&)>& made = {});
int brickmakeCommand(const BrickmakeCommand& command);

struct ViewCommand {
  std::string input, output, channel, camera;  ///< camera: a RIB file with the camera to use; if empty, an overview.
  int level = -1;
  float gain = 0;
  std::array<int, 2> size{640, 480};
};
int viewCommand(const ViewCommand& command);

struct ConvertCommand {
  std::string input, output;  ///< One is a .ptc, the other a .ply.
  float radius = 0;           ///< Radius of points that have none.
};
int convertCommand(const ConvertCommand& command);

}  // namespace tomales
