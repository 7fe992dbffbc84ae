// Shaders in the RenderMan Shading Language: a .sl file becomes shaders that are bound and run like any others. Nothing
// of a file is machine code: a stranger's shader can read the files that it includes, and compute.
// Threads: compile() and the shaders may be used by any number at once.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "reyes/shader_api.h"

namespace tomales {

struct RslSettings {
  std::vector<std::string> includeFolders{};  ///< Of #include, besides that of the file.
  std::vector<std::pair<std::string, std::string>> definitions{};
};

/// What a TmParamDecl does not say of a parameter.
struct RslParameter {
  std::string detail;     ///< "uniform", "varying", or empty: its file does not say.
  bool computed = false;  ///< Its default is no constant: the shader computes it.
};

/// A file, compiled. Lives at least as long as its shaders are used.
class RslFile {
 public:
  /// Never null: what is wrong is in messages().
  static std::shared_ptr<const RslFile> compile(const std::string& path, const RslSettings& settings);
  ~RslFile();

  /// None if there are errors. A transformation shader is checked and left out: nothing runs it.
  const TmShaderLibrary* library() const;
  /// Of a surface that assigns P: what moves the points, a displacement with the same name and parameters, which
  /// library() leaves out. Null: it moves none.
  const TmShader* displacementOf(const std::string& surface) const;
  /// In the order of TmShader::params.
  std::vector<RslParameter> parameters(const TmShader& shader) const;
  /// As compilers print them, with lines and carets; empty: all is well.
  const std::string& messages() const;
  int errors() const;
  int warnings() const;
  /// Functions that a shader calls and nobody has: it runs, with substitutes.
  int missing() const;
  /// The first error, in one line: "file:line:column: text"; empty: none.
  std::string firstError() const;
  /// The file itself, and all that it includes.
  std::vector<std::string> files() const;

  /// What a stage has made of it: tokens, tree, types, lowered or code.
  static std::string dump(const std::string& path, const RslSettings& settings, const std::string& stage);

 private:
  struct Impl;
  RslFile();
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
