#include "reyes/shade/rsl_shaders.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <sstream>

#include "reyes/base/input_file.h"
#include "reyes/shade.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// Endings of shaders that other renderers have compiled.
constexpr const char* kCompiled[] = {".slo", ".sdr", ".slx", ".slc", ".sdl", ".dll", ".sl"};

/// When a file was written, and how large it is; zeros: there is none.
std::pair<fs::file_time_type, uintmax_t> stateOf(const std::string& path) {
  std::error_code none;
  const auto time = fs::last_write_time(path, none);
  const uintmax_t size = fs::file_size(path, none);
  return none ? std::pair<fs::file_time_type, uintmax_t>{} : std::pair{time, size};
}

/// One compiled file. It is never given back, since what is bound may outlive whoever asked.
struct Compiled {
  std::shared_ptr<const RslFile> file;
  std::vector<std::pair<std::string, std::pair<fs::file_time_type, uintmax_t>>> read;
  bool isCurrent() const {
    return std::all_of(read.begin(), read.end(), [](const auto& r) { return stateOf(r.first) == r.second; });
  }
};

class Files {
 public:
  std::shared_ptr<const RslFile> compiled(const std::string& path, const std::vector<std::string>& folders) {
    const std::pair key(path, folders);
    {
      const std::lock_guard lock(mutex_);
      if (const auto it = current_.find(key); it != current_.end() && it->second->isCurrent()) return it->second->file;
    }
    Compiled made{RslFile::compile(path, {.includeFolders = folders}), {}};
    for (const std::string& file : made.file->files()) made.read.push_back({file, stateOf(file)});
    const std::lock_guard lock(mutex_);
    current_[key] = &all_.emplace_back(std::move(made));
    return current_[key]->file;
  }

 private:
  std::mutex mutex_;
  std::deque<Compiled> all_;
  std::map<std::pair<std::string, std::vector<std::string>>, const Compiled*> current_;
};

Files& files() {
  static Files all;
  return all;
}

/// Does the text of a file seem to hold a shader of that name? The compiler tells in the end.
bool mentions(const fs::path& path, const std::string& name) {
  if (!inputProblem(path.string()).empty()) return false;
  std::ifstream in(path);
  std::stringstream text;
  text << in.rdbuf();
  const std::string all = text.str();
  for (size_t at = all.find(name); at != std::string::npos; at = all.find(name, at + 1)) {
    size_t before = at;
    while (before > 0 && std::isspace(static_cast<unsigned char>(all[before - 1]))) --before;
    if (before == at) continue;
    for (const char* kind : {"surface", "light", "displacement", "volume", "imager"}) {
      const size_t n = std::char_traits<char>::length(kind);
      if (before >= n && all.compare(before - n, n, kind) == 0) return true;
    }
  }
  return false;
}

std::string lowered(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string> candidates(const std::string& name, const std::vector<std::string>& folders) {
  std::vector<std::string> out;
  std::error_code none;
  for (const std::string& folder : folders)
    if (const fs::path file = fs::path(folder) / (name + ".sl"); fs::is_regular_file(file, none))
      out.push_back(file.string());
  if (!out.empty() || name.find('/') != std::string::npos) return out;
  constexpr int kMostFiles = 5000;  // a folder that holds much else is not searched to its end
  int looked = 0;
  for (const std::string& folder : folders) {
    std::vector<fs::path> here;
    for (auto it = fs::directory_iterator(folder, none); !none && it != fs::directory_iterator(); it.increment(none))
      if (it->path().extension() == ".sl" && ++looked < kMostFiles) here.push_back(it->path());
    std::sort(here.begin(), here.end());
    for (const fs::path& file : here)
      if (mentions(file, name)) out.push_back(file.string());
    // Scenes from systems that do not tell capitals in names of files.
    for (const fs::path& file : here)
      if (lowered(file.stem().string()) == lowered(name)) out.push_back(file.string());
  }
  return out;
}

/// A shader for another renderer, where there is no .sl.
std::string compiledElsewhere(const std::string& name, const std::vector<std::string>& folders) {
  std::error_code none;
  for (const std::string& folder : folders)
    for (const char* ending : kCompiled)
      if (const fs::path file = fs::path(folder) / (name + ending); fs::is_regular_file(file, none))
        return file.string();
  return {};
}

}  // namespace

std::string withoutShaderEnding(const std::string& name) {
  for (const char* ending : kCompiled)
    if (name.size() > std::char_traits<char>::length(ending) && name.ends_with(ending))
      return name.substr(0, name.size() - std::char_traits<char>::length(ending));
  return name;
}

RslFound findRslShader(const std::string& written, TmKind kind, const std::vector<std::string>& folders) {
  std::string name = withoutShaderEnding(written);
  if (const fs::path path(name); path.is_absolute() || name.find("..") != std::string::npos)
    name = path.filename().string();  // a scene from elsewhere: its shader may lie in the folders
  const std::string shaderName = fs::path(name).filename().string();
  RslFound out;
  for (const std::string& file : candidates(name, folders)) {
    const std::shared_ptr<const RslFile> compiled = files().compiled(file, folders);
    if (compiled->errors() > 0) {
      if (out.file.empty()) out.file = file, out.problem = compiled->messages();
      continue;
    }
    const TmShaderLibrary& library = *compiled->library();
    // A file with one shader of another name than its own is meant where the file is named.
    const bool only = library.count == 1 && lowered(fs::path(file).stem().string()) == lowered(shaderName);
    std::string others;
    for (int32_t k = 0; k < library.count; ++k) {
      const TmShader* s = library.shaders[k];
      if (s->kind == kind && (only || s->name == shaderName)) return {s, file, {}, {}};
      others += fmt::format("{}{} \"{}\"", others.empty() ? "" : ", ", kindName(static_cast<TmKind>(s->kind)), s->name);
    }
    if (out.file.empty())
      out.file = file, out.problem = fmt::format("has no {} \"{}\", but {}", kindName(kind), shaderName,
                                                 others.empty() ? "no shader at all" : others);
  }
  if (out.file.empty())
    if (const std::string other = compiledElsewhere(name, folders); !other.empty())
      out.remark = fmt::format("{} is compiled for another renderer; put its .sl beside it", other);
  return out;
}

}  // namespace tomales
