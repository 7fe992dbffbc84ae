#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "reyes/rsl.h"
#include "reyes/rsl/hosted_shader.h"
#include "reyes/rsl/lower.h"
#include "reyes/rsl/parse.h"
#include "reyes/rsl_host.h"

namespace tomales {

using namespace compiler;

struct RslFile::Impl {
  Sources sources;
  Messages messages;
  Checked checked;
  std::deque<HostedShader> shaders;
  std::vector<const TmShader*> hosts;
  TmShaderLibrary library{};
  std::string rendered;
};

namespace {

PreprocessOptions optionsOf(const RslSettings& settings) {
  PreprocessOptions out;
  out.includeFolders = settings.includeFolders;
  for (const auto& [name, value] : settings.definitions) out.definitions.push_back({name, value});
  return out;
}

Code loweredFrom(const Checked& checked, const Shader& shader, const std::string& path, Messages& messages,
                 bool onGeometry = false) {
  Code out = lower(checked, shader, messages, onGeometry);
  out.path = path;
  return out;
}

}  // namespace

std::string rslNameOf(const TmFunction& function) {
  const std::optional<Builtin> b = builtinOf(function);
  return b ? b->name : std::string();
}

const TmShader* rslAreaLight(const TmShader& light) {
  const HostedShader* shader = HostedShader::of(light);
  const HostedShader* form = shader ? shader->areaForm() : nullptr;
  return form ? form->host() : nullptr;
}

bool isMean(const TmShader& light) {
  const HostedShader* shader = HostedShader::of(light);
  return shader && shader->lowered().onGeometry;
}

bool shinesAllRound(const TmShader& light, const TmValue* params) {
  const HostedShader* shader = HostedShader::of(light);
  return shader && shader->shinesAllRound(params);
}

std::vector<std::string> rslTexts(const TmShader& shader) {
  std::vector<std::string> out;
  if (const HostedShader* hosted = HostedShader::of(shader))
    for (const Register& r : hosted->code().registers)
      if (r.origin == Origin::Constant) out.insert(out.end(), r.texts.begin(), r.texts.end());
  return out;
}

RslFile::RslFile() : impl_(new Impl) {}
RslFile::~RslFile() = default;

std::shared_ptr<const RslFile> RslFile::compile(const std::string& path, const RslSettings& settings) {
  const std::shared_ptr<RslFile> file(new RslFile);
  Impl& f = *file->impl_;
  f.checked = check(parse(preprocess(path, optionsOf(settings), f.sources, f.messages), f.messages), f.messages,
                    settings.functions);
  if (!f.messages.hasErrors())
    for (const auto& s : f.checked.file.shaders) {
      HostedShader& shader = f.shaders.emplace_back(loweredFrom(f.checked, *s, path, f.messages), f.messages);
      Messages told;  // the first lowering has reported the same
      if (shader.canBeOnGeometry())
        shader.setAreaForm(std::make_unique<HostedShader>(loweredFrom(f.checked, *s, path, told, true), told));
    }
  if (!f.messages.hasErrors())
    for (const HostedShader& p : f.shaders)
      if (const TmShader* host = p.host()) f.hosts.push_back(host);
  f.library = {TM_SHADER_ABI, sizeof f.library, f.hosts.data(), nullptr, static_cast<int32_t>(f.hosts.size())};
  f.rendered = f.messages.rendered(f.sources);
  return file;
}

const TmShaderLibrary* RslFile::library() const { return &impl_->library; }
const std::string& RslFile::messages() const { return impl_->rendered; }

const TmShader* RslFile::displacementOf(const std::string& surface) const {
  for (const HostedShader& s : impl_->shaders)
    if (s.displacement() && s.lowered().name == surface) return s.displacement()->host();
  return nullptr;
}

int RslFile::errors() const { return impl_->messages.errorCount(); }

int RslFile::missing() const { return impl_->messages.missingCount(); }

int RslFile::warnings() const {
  int n = 0;
  for (const Message& m : impl_->messages.all()) n += m.severity == Severity::Warning;
  return n;
}

std::string RslFile::firstError() const {
  for (const Message& m : impl_->messages.all())
    if (m.severity == Severity::Error)
      return fmt::format("{}: {}", impl_->sources.text(impl_->sources.outermost(m.place)), m.text);
  return {};
}

std::vector<std::string> RslFile::files() const {
  std::vector<std::string> out;
  for (size_t k = 0; k < impl_->sources.fileCount(); ++k)
    out.push_back(impl_->sources.file(static_cast<int32_t>(k)).path);
  return out;
}

std::vector<RslParameter> RslFile::parameters(const TmShader& shader) const {
  std::vector<RslParameter> out;
  for (const HostedShader& p : impl_->shaders) {
    if (p.host() != &shader) continue;
    for (const Parameter& parameter : p.lowered().parameters)
      out.push_back({parameter.detail == Detail::Varying   ? "varying"
                     : parameter.detail == Detail::Uniform ? "uniform"
                                                           : "",
                     parameter.computed});
  }
  return out;
}

std::string RslFile::dump(const std::string& path, const RslSettings& settings, const std::string& stage) {
  Sources sources;
  Messages messages;
  const std::vector<Token> tokens = preprocess(path, optionsOf(settings), sources, messages);
  if (stage == "tokens") return compiler::dump(tokens, sources);
  File file = parse(tokens, messages);
  if (stage == "tree") return compiler::dump(file);
  const Checked checked = check(std::move(file), messages, settings.functions);
  if (stage == "types") return compiler::dump(checked.file);
  std::string out;
  if (messages.hasErrors()) return out;
  for (const auto& s : checked.file.shaders) {
    const HostedShader hosted(loweredFrom(checked, *s, path, messages), messages);
    out += compiler::dump(stage == "lowered" ? hosted.lowered() : hosted.code());
  }
  return out;
}

}  // namespace tomales
