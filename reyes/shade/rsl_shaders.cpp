#include "reyes/shade/rsl_shaders.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <set>
#include <sstream>
#include <tuple>

#include "reyes/base/file_guesses.h"
#include "reyes/base/input_file.h"
#include "reyes/base/parallel.h"
#include "reyes/base/text.h"
#include "reyes/shade.h"
#include "reyes/shader_registry.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// Endings of shaders that other renderers have compiled.
constexpr const char* kCompiled[] = {".slo", ".sdr", ".slx", ".slc", ".sdl", ".dll", ".sl"};

/// The time when a file was written, and its size; zeros if there is no file.
using FileState = std::pair<fs::file_time_type, uintmax_t>;
FileState stateOf(const std::string& path) {
  std::error_code none;
  const auto time = fs::last_write_time(path, none);
  const uintmax_t size = fs::file_size(path, none);
  return none ? FileState{} : FileState{time, size};
}

/// One compiled file. It is never freed, since bound shaders may outlive everything else.
struct Compiled {
  std::shared_ptr<const RslFile> file;
  std::vector<std::pair<std::string, FileState>> read;
  bool isCurrent() const {
    return std::all_of(read.begin(), read.end(), [](const auto& r) { return stateOf(r.first) == r.second; });
  }
};

class Files {
 public:
  std::shared_ptr<const RslFile> compiled(const std::string& path, const std::vector<std::string>& folders,
                                          const FunctionsOfFolders& functions) {
    const Key key(path, folders, functions.folders());
    {
      const std::lock_guard lock(mutex_);
      if (const auto it = current_.find(key); it != current_.end() && it->second->isCurrent()) return it->second->file;
    }
    Compiled made{RslFile::compile(path, {.includeFolders = folders, .functions = &functions}), {}};
    for (const std::string& file : made.file->files()) made.read.push_back({file, stateOf(file)});
    const std::lock_guard lock(mutex_);
    current_[key] = &all_.emplace_back(std::move(made));
    return current_[key]->file;
  }

  std::vector<std::string> readFor(const std::string& path) {
    const std::lock_guard lock(mutex_);
    for (const auto& [key, made] : current_)
      if (std::get<0>(key) == path && made->isCurrent()) return made->file->files();
    return {};
  }

 private:
  /// The file, the folders of headers, and those of functions.
  using Key = std::tuple<std::string, std::vector<std::string>, std::vector<std::string>>;
  std::mutex mutex_;
  std::deque<Compiled> all_;
  std::map<Key, const Compiled*> current_;
};

Files& files() {
  static Files all;
  return all;
}

/// Finds the names behind the words that begin a shader in a file's text, but for macros. Only the compiler knows them
/// for certain.
std::set<std::string> namesIn(const std::string& path) {
  std::set<std::string> out;
  if (!inputProblem(path).empty()) return out;
  std::ifstream in(path);
  std::stringstream stream;
  stream << in.rdbuf();
  const std::string text = stream.str();
  const auto isSpace = [&](size_t at) {
    return at < text.size() && std::isspace(static_cast<unsigned char>(text[at]));
  };
  const auto isOfName = [&](size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_');
  };
  for (const std::string_view kind : {"surface", "light", "displacement", "volume", "imager", "class"})
    for (size_t at = text.find(kind); at != std::string::npos; at = text.find(kind, at + 1)) {
      size_t begin = at + kind.size();
      if (!isSpace(begin)) continue;
      while (isSpace(begin)) ++begin;
      size_t end = begin;
      while (isOfName(end)) ++end;
      if (end > begin) out.insert(text.substr(begin, end - begin));
    }
  constexpr std::string_view kDefine = "#define";
  for (size_t at = text.find(kDefine); at != std::string::npos; at = text.find(kDefine, at + 1)) {
    size_t begin = at + kDefine.size();
    while (isSpace(begin)) ++begin;
    size_t end = begin;
    while (isOfName(end)) ++end;
    out.erase(text.substr(begin, end - begin));
  }
  return out;
}

/// Keeps the results of namesIn() for files that have not changed since.
class Names {
 public:
  bool has(const std::string& path, const std::string& name) {
    const std::lock_guard lock(mutex_);
    return of(path).contains(name);
  }
  /// Tells whether the text of the file names shaders, and this one is not among them.
  bool hasOthers(const std::string& path, const std::string& name) {
    const std::lock_guard lock(mutex_);
    const std::set<std::string>& found = of(path);
    return !found.empty() && !found.contains(name);
  }

 private:
  const std::set<std::string>& of(const std::string& path) {
    const auto state = stateOf(path);
    const auto [it, isNew] = files_.try_emplace(path);
    if (isNew || it->second.first != state) it->second = {state, namesIn(path)};
    return it->second.second;
  }

  std::mutex mutex_;
  std::map<std::string, std::pair<FileState, std::set<std::string>>> files_;
};

Names& names() {
  static Names all;
  return all;
}

/// Reads folders until they hold too many files.
class Folders {
 public:
  /// Returns the .sl files of the folder, sorted.
  std::vector<fs::path> sourcesIn(const std::string& folder) {
    std::vector<fs::path> out;
    std::error_code none;
    for (auto it = fs::directory_iterator(folder, none); !none && it != fs::directory_iterator(); it.increment(none))
      if (it->path().extension() == ".sl" && ++looked_ < kMostFiles) out.push_back(it->path());
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  static constexpr int kMostFiles = 5000;
  int looked_ = 0;
};

void addHolders(const std::vector<fs::path>& sources, const std::string& name, std::vector<std::string>& out) {
  for (const fs::path& file : sources)
    if (names().has(file.string(), name)) out.push_back(file.string());
}

/// Returns the last part of a name that has folders before it, and else all of it.
std::string withoutFolders(const std::string& name) {
  const std::string last = lastPartOf(name);
  return last.empty() ? name : last;
}

std::vector<std::string> candidates(const std::string& name, const std::vector<std::string>& folders) {
  std::vector<std::string> out;
  std::error_code none;
  Folders all;
  const std::string shader = withoutFolders(name);
  const auto take = [&](const std::string& meant) {
    for (const std::string& folder : folders) {
      const fs::path file = fs::path(folder) / meant;
      if (!fs::is_regular_file(file, none)) continue;
      // Other compilers name what they make after the shader, so a file's name means less than the shader's.
      if (names().hasOthers(file.string(), shader)) addHolders(all.sourcesIn(file.parent_path().string()), shader, out);
      out.push_back(file.string());
    }
  };
  take(name + ".sl");
  // Exporters name files relative to the folder of the project, or by the folders of their machine. What lies in the
  // folders of the search path comes before what lies in folders above them.
  const std::vector<std::string> ends = pathSuffixes(name + ".sl", folders);
  for (const bool isAbove : {false, true})
    for (const std::string& end : ends)
      if (out.empty() && fs::path(end).is_absolute() == isAbove) take(end);
  if (!out.empty()) return out;
  if (shader != name) return candidates(shader, folders);
  for (const std::string& folder : folders) {
    const std::vector<fs::path> here = all.sourcesIn(folder);
    addHolders(here, name, out);
    // Some systems do not distinguish capitals in file names, and scenes come from there.
    for (const fs::path& file : here)
      if (lowerCase(file.stem().string()) == lowerCase(name)) out.push_back(file.string());
  }
  return out;
}

/// Returns the file of a shader that another renderer has compiled, where there is no .sl.
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

std::vector<std::string> filesOfRslFile(const std::string& file) { return files().readFor(file); }

RslFound findRslShader(const std::string& written, TmKind kind, const std::vector<std::string>& folders,
                       const FunctionsOfFolders& functions) {
  const std::string name = withoutShaderEnding(written), shaderName = withoutFolders(name);
  RslFound out;
  for (const std::string& file : candidates(name, folders)) {
    const std::shared_ptr<const RslFile> compiled = files().compiled(file, folders, functions);
    if (compiled->errors() > 0) {
      if (out.file.empty()) {
        out.file = file;
        out.problem = compiled->messages();
      }
      continue;
    }
    const TmShaderLibrary& library = *compiled->library();
    // A file with one shader of another name is meant if a request names the file.
    const bool only = library.count == 1 && lowerCase(fs::path(file).stem().string()) == lowerCase(shaderName);
    std::string others;
    for (int32_t k = 0; k < library.count; ++k) {
      const TmShader* s = library.shaders[k];
      if (s->kind == kind && (only || s->name == shaderName))
        return {s, compiled->displacementOf(s->name), file, {}, {}};
      others += fmt::format("{}{} \"{}\"", others.empty() ? "" : ", ", kindName(static_cast<TmKind>(s->kind)), s->name);
    }
    if (out.file.empty()) {
      out.file = file;
      out.problem = fmt::format("has no {} \"{}\", but {}", kindName(kind), shaderName,
                                others.empty() ? "no shader at all" : others);
    }
  }
  if (out.file.empty())
    if (const std::string other = compiledElsewhere(name, folders); !other.empty())
      out.remark = fmt::format("{} is compiled for another renderer; put its .sl beside it", other);
  return out;
}

void compileRslShaders(const std::vector<RslRequest>& requests, const FunctionsOfFolders& functions) {
  std::set<std::pair<std::string, std::vector<std::string>>> wanted;
  for (const RslRequest& r : requests)
    if (const auto found = candidates(withoutShaderEnding(r.name), r.folders); !found.empty())
      wanted.emplace(found.front(), r.folders);
  const std::vector<std::pair<std::string, std::vector<std::string>>> each(wanted.begin(), wanted.end());
  parallelFor(each.size(), 1,
              [&](size_t begin, size_t) { files().compiled(each[begin].first, each[begin].second, functions); });
}

}  // namespace tomales
