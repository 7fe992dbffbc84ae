// Shaders in the RenderMan Shading Language: a .sl file becomes shaders that are bound and run like any others. Nothing
// of a file is machine code: a stranger's shader can read the files that it includes, and compute.
// Threads: compile() and the shaders may be used by any number at once.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reyes/shader/functions.h"
#include "reyes/shader_api.h"

namespace tomales {

/// Functions that shaders may call besides those of the language: plugins bring them. Threads: any.
class RslFunctions {
 public:
  virtual ~RslFunctions() = default;
  /// Returns the functions of that name, which live as long as the process.
  virtual std::vector<const TmFunction*> named(const std::string& name) const = 0;
};

/// Returns the name by which a shader calls the function. It is empty if the prototype is not one that
/// reyes/shader/functions.h describes, or if there is no code.
std::string rslNameOf(const TmFunction& function);

struct RslSettings {
  std::vector<std::string> includeFolders{};  ///< The folders of #include, besides that of the file.
  std::vector<std::pair<std::string, std::string>> definitions{};
  const RslFunctions* functions = nullptr;  ///< Null if there are none.
};

/// The facts that RSL gives about a parameter beyond its TmParamDecl.
struct RslParameter {
  std::string detail;     ///< "uniform", "varying", or empty if the file does not say.
  bool computed = false;  ///< True if the default is not constant, so that the shader computes it.
};

/// A compiled file. It must live as long as its shaders are used.
class RslFile {
 public:
  /// Never returns null: messages() tells what is wrong.
  static std::shared_ptr<const RslFile> compile(const std::string& path, const RslSettings& settings);
  ~RslFile();

  /// Returns null if there are errors. A transformation shader is checked and left out: nothing runs it.
  const TmShaderLibrary* library() const;
  /// Returns the displacement that moves the points of a surface that assigns P, with the same name and parameters.
  /// library() leaves it out. Returns null if the surface does not move them.
  const TmShader* displacementOf(const std::string& surface) const;
  /// Returns the parameters in the order of TmShader::params.
  std::vector<RslParameter> parameters(const TmShader& shader) const;
  /// Returns the errors and warnings as compilers print them, with lines and carets. Empty if all is well.
  const std::string& messages() const;
  int errors() const;
  int warnings() const;
  /// Returns the number of functions that a shader calls and nobody has. It runs nevertheless, with substitutes.
  int missing() const;
  /// Returns the first error, in one line: "file:line:column: text". Empty if there is none.
  std::string firstError() const;
  /// Returns the file itself, and all that it includes.
  std::vector<std::string> files() const;

  /// Prints what a stage makes of the file: tokens, tree, types, lowered or code.
  static std::string dump(const std::string& path, const RslSettings& settings, const std::string& stage);

 private:
  struct Impl;
  RslFile();
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
