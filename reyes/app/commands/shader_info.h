// What `tomales info` and `tomales list` say of shaders.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "reyes/shader_registry.h"

namespace tomales {

using Json = nlohmann::ordered_json;

/// Name, kind, documentation and parameters.
Json shaderInfo(const TmShader& shader);
/// Of all shaders of a file: a text in the shading language, or a plugin. Null, and reported: it cannot be read.
Json textInfo(const std::string& path, Log& log);
Json pluginInfo(const std::string& path, Log& log);
/// Of a shader in NAME.sl, NAME.so or built in; null, and reported: there is none.
Json namedShaderInfo(const std::string& name, const PluginTrust& trust, Log& log);

/// Is it an array of values that fit on a line?
bool isScalarList(const Json& value);
/// A value as `tomales info` prints it on a line.
std::string lineOf(const Json& value);

}  // namespace tomales
