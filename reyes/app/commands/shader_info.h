// The part of `tomales info` and `tomales list` for shaders.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "reyes/shader_registry.h"

namespace tomales {

using Json = nlohmann::ordered_json;

/// Returns name, kind, documentation and parameters.
Json shaderInfo(const TmShader& shader);
/// Describe the shaders of a file: a text in the shading language, or a plugin. Return null if it is unreadable, which
/// is reported.
Json textInfo(const std::string& path, Log& log);
Json pluginInfo(const std::string& path, Log& log);
/// Describes a shader in NAME.sl, NAME.so or built in. Returns null if there is none, which is reported.
Json namedShaderInfo(const std::string& name, const PluginTrust& trust, Log& log);

/// Tells whether it is an array of values that fit on a line.
bool isScalarList(const Json& value);
/// Returns a value as `tomales info` prints it on a line.
std::string lineOf(const Json& value);

}  // namespace tomales
