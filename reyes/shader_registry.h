// Shaders by name: those of the program, of plugins, and of texts in RSL. Threads: any.
#pragma once
#include <memory>
#include <optional>
#include <span>

#include "reyes/base/log.h"
#include "reyes/base/plugin_trust.h"
#include "reyes/rsl.h"
#include "reyes/shader_api.h"

namespace tomales {

/// Returns "surface" ... "imager".
const char* kindName(TmKind kind);
/// Returns "float" ... "matrix" for a TmType; "unknown type" for another number.
const char* typeName(int32_t type);
/// Returns the floats in one value of a TmType; 0 for strings.
int floatsOf(int32_t type);
/// Returns the name of a TmRole; null if no role has this number.
const char* roleName(int32_t role);
/// Returns the role that a shader's parameter declares. If it declares none, returns the role of the standard parameter
/// of the same name and type.
TmRole roleOf(const TmShader& shader, const TmParamDecl& decl);
/// Tells whether all that a light sends is in proportion to a parameter with this role.
constexpr bool isFactor(TmRole role) { return role == TM_ROLE_SCALE || role == TM_ROLE_TINT; }
/// Returns the parameters that every shader of a kind understands, whether or not it declares them.
std::span<const TmParamDecl> standardParams(TmKind kind);

/// The name of a shader that a scene asks for.
struct ShaderName {
  std::string name;
  TmKind kind;
  std::string beside{};  ///< The folder of the file that names the shader; empty if no file does.
};

/// The displacement "surface:NAME" is the part of the surface NAME that moves points (RslFile::displacementOf).
constexpr const char* kOfSurface = "surface:";

/// The known shaders. Built-in ones and plugins share one table.
class ShaderRegistry {
 public:
  /// `standardFromFiles`: whether a file with the name of a standard shader, whose look RISpec fixes ("plastic"), comes
  /// before the built-in one. If this is not given, the file comes first if it has parameters that the built-in one
  /// lacks.
  explicit ShaderRegistry(Log& log, PluginTrust trust = {}, std::optional<bool> standardFromFiles = {});
  ~ShaderRegistry();
  /// Checks versions and sizes before it touches anything else. Later libraries win over earlier ones.
  bool addLibrary(const TmShaderLibrary* library, const std::string& origin);
  /// Opens a .so and adds it. Returns false, with a message, if it is not a shader plugin of this ABI.
  bool loadPlugin(const std::string& path);
  /// Adds the shaders of a compiled .sl file, which then come before others of their names.
  bool addText(const std::shared_ptr<const RslFile>& file, const std::string& path);
  /// Finds a shader by name and kind, in this order:
  ///   1 shaders that have been loaded and, unless such a file comes before, built-in ones whose look RISpec fixes
  ///   2 NAME.so in the trusted folders
  ///   3 NAME.sl along `searchPath`, in the trusted folders, and in `beside`, the folder of the file that names it
  ///   4 other built-in ones
  ///   5 NAME.so along `searchPath`
  /// `searchPath` is the scene's: folders separated by colons; if it is empty, the working folder. A plugin in a folder
  /// that is not trusted is reported, once, and not loaded. So is a plugin outside of the trusted folders that an
  /// absolute name, or a name with "..", leads to. A .sl that has errors is reported with all of them. If a .sl has a
  /// name of RISpec's, a message says whose shader is used.
  const TmShader* find(const std::string& name, TmKind kind, const std::string& searchPath,
                       const std::string& beside = {});
  /// Compiles the texts of these shaders at once, on all threads, so that find() only has to look. It reports nothing:
  /// find() reports what is wrong, as it would without this call.
  void prepare(const std::vector<ShaderName>& names, const std::string& searchPath);
  /// Returns the folders where find() looks for the text of a shader.
  std::vector<std::string> textFolders(const std::string& searchPath, const std::string& beside) const;
  /// Returns the functions of plugins that shaders in RSL may call: those of the trusted folders and, as far as folders
  /// of the scene are trusted, those along `searchPath`. They must not outlive the registry.
  std::unique_ptr<const RslFunctions> functions(const std::string& searchPath) const;
  /// Returns the end of a message about a shader that find() has not found. It tells what else has that name or a
  /// similar one.
  std::string hintOfMissing(const std::string& name, TmKind kind, const std::string& searchPath,
                            const std::string& beside) const;
  std::vector<const TmShader*> all() const;
  /// Returns the origin that addLibrary() was given for a shader, or the file that it is from.
  std::string originOf(const TmShader& shader) const;
  /// Returns all files that a shader is made of: its text with those that it includes, or its plugin. A built-in shader
  /// has none.
  std::vector<std::string> filesOf(const TmShader& shader) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tomales
