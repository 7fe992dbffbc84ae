// Shaders that a scene names and whose .sl lies where it looks for shaders: found, compiled and kept.
// Threads: any.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "reyes/rsl.h"

namespace tomales {

/// The name without the ending that shaders have which other renderers have compiled, or texts (.slo, .sl).
std::string withoutShaderEnding(const std::string& name);

/// What became of a name.
struct RslFound {
  const TmShader* shader = nullptr;
  const TmShader* displacement = nullptr;  ///< RslFile::displacementOf()
  std::string file;                        ///< That has, or should have, the shader; empty: there is none.
  std::string problem;                     ///< Why there is no shader; empty: there is one, or no file.
  std::string remark;                      ///< What the user is to know besides.
};

/// `name` as RIB has it: endings of compiled shaders (.slo, .sdr, .slx, ...) stand for the .sl beside them. Files are
/// NAME.sl in the folders, in their order; else a .sl file there in which a shader of that name is. The folders are
/// those of #include too. A file is compiled once for the process, and again when it or what it includes has changed.
RslFound findRslShader(const std::string& name, TmKind kind, const std::vector<std::string>& folders);

/// A name, and where it is looked for.
struct RslRequest {
  std::string name;
  std::vector<std::string> folders;
};
/// Compiles, on all threads, the files that findRslShader() will take first for these names, which then only has to
/// look. It says nothing: findRslShader() tells what is wrong, in the order in which it is asked.
void compileRslShaders(const std::vector<RslRequest>& requests);

}  // namespace tomales
