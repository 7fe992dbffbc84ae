// The shaders that a frame may use.
#pragma once
#include "reyes/app/settings.h"
#include "reyes/shade.h"
#include "reyes/shader_registry.h"

namespace tomales {

/// Returns a registry that knows the built-in shaders, and finds whatever else the settings allow. Everything that asks
/// for the shaders of one frame shares one registry: each file is then loaded once, and what is wrong with it is
/// reported once.
inline std::unique_ptr<ShaderRegistry> frameShaders(const RenderSettings& settings, Log& log) {
  auto registry = std::make_unique<ShaderRegistry>(log, pluginTrust(settings), settings.input.standardFromFiles);
  registry->addLibrary(tomales_builtin_shaders(), "built-in");
  return registry;
}

}  // namespace tomales
