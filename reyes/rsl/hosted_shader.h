// A shader of a .sl file as the host sees it. Its code is optimised once for each set of parameters that primitive
// variables give, so that values that do not vary are computed once for a batch. Threads: any number may call shade().
#pragma once
#include <map>
#include <memory>
#include <mutex>

#include "reyes/rsl/check.h"
#include "reyes/rsl/machine/program.h"
#include "reyes/rsl_host.h"
#include "reyes/shader_api.h"

namespace tomales::compiler {

class HostedShader {
 public:
  /// Optimises the code with all parameters uniform. Errors go to `messages`; if there are any, it cannot be run.
  HostedShader(Code lowered, Messages& messages);
  HostedShader(const HostedShader&) = delete;

  /// Returns null if the host has no shaders of this kind.
  const TmShader* host() const { return code().kind == ShaderKind::Transformation ? nullptr : &host_.shader; }
  /// Tells whether a light reads its own place, so that it can be lowered onto the geometry of AreaLightSource.
  bool canBeOnGeometry() const;
  void setAreaForm(std::unique_ptr<const HostedShader> form) { area_ = std::move(form); }
  /// Returns the form of a light that AreaLightSource runs, or null.
  const HostedShader* areaForm() const { return area_.get(); }
  /// Returns null if the shader is not a HostedShader's.
  static const HostedShader* of(const TmShader& shader);
  const Code& code() const { return uniform_->code(); }
  const Code& lowered() const { return lowered_; }
  /// Tells whether the shader computes the default of that parameter.
  bool computes(size_t parameter) const;
  /// These two are rslValue() and rslFixedValue() (reyes/rsl_host.h). Pre: computes(parameter).
  RslValue value(size_t parameter, const TmGrid& grid) const;
  std::optional<RslValue> fixedValue(size_t parameter, const TmValue* params) const;
  /// This is shinesAllRound() (reyes/rsl_host.h).
  bool shinesAllRound(const TmValue* params) const;
  /// Returns the part of a surface that assigns P, as a displacement (passes/moving.cpp); null if the shader does not.
  const HostedShader* displacement() const { return displacement_.get(); }

 private:
  static void shade(const TmGrid* grid);
  /// Returns for each parameter whether it varies; empty if none does.
  std::vector<bool> varyingOf(const TmValue* params) const;
  const Program& programFor(const TmGrid& grid) const;
  const Program& defaultProgram(size_t parameter, const TmValue* params) const;
  const Program* coneProgram() const;
  void declareParameters();
  void declareExtent();
  void declareForHost(const char* name, TmRole role, const float* value);

  Code lowered_;
  std::unique_ptr<const HostedShader> displacement_;
  std::unique_ptr<const Program> uniform_;
  mutable std::mutex mutex_;
  /// Indexed by the parameters that vary.
  mutable std::map<std::vector<bool>, std::unique_ptr<const Program>> others_;
  /// The codes of defaults (defaultOf()), by parameter and by the parameters that vary.
  mutable std::map<std::pair<size_t, std::vector<bool>>, std::unique_ptr<const Program>> defaults_;
  mutable std::unique_ptr<const Program> cone_;  ///< That of coneOf().
  std::vector<TmParamDecl> params_;
  std::vector<std::vector<const char*>> strings_;
  struct Hosted {
    TmShader shader{};
    const HostedShader* owner = nullptr;
  } host_;  ///< The host has the address of the first member, by which shade() finds the rest.
  std::unique_ptr<const HostedShader> area_;  ///< areaForm(), or null.
};

}  // namespace tomales::compiler
