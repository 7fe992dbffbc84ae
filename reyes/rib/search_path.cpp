#include "reyes/rib/search_path.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "reyes/base/search_path.h"

namespace tomales::rib {
namespace {

bool inName(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Returns the value of the variable whose '$' is at text[at], and moves `at` to its last character.
std::string environmentAt(const std::string& text, size_t& at, std::string& unset) {
  const bool braces = at + 1 < text.size() && text[at + 1] == '{';
  const size_t first = at + (braces ? 2 : 1);
  size_t last = first;
  while (last < text.size() && (braces ? text[last] != '}' : inName(text[last]))) ++last;
  const std::string name = text.substr(first, last - first);
  const bool whole = !name.empty() && (!braces || last < text.size());
  if (!whole) return "$";
  at = braces ? last : last - 1;
  const char* value = std::getenv(name.c_str());
  const bool isNamed = (", " + unset + ",").find(", " + name + ",") != std::string::npos;
  if (!value && !isNamed) unset += (unset.empty() ? "" : ", ") + name;
  return value ? value : "";
}

std::vector<std::string> quoted(const std::string& text) {
  std::vector<std::string> out;
  for (size_t open = text.find('"'); open != std::string::npos;) {
    const size_t close = text.find('"', open + 1);
    if (close == std::string::npos) break;
    out.push_back(text.substr(open + 1, close - open - 1));
    open = text.find('"', close + 1);
  }
  return out;
}

}  // namespace

std::string expandSearchPath(const std::string& written, const std::string& previous, std::string& unset) {
  std::string out;
  for (size_t i = 0; i < written.size() && out.size() <= kLongestSearchPath; ++i) {
    const char c = written[i];
    const bool starts = i == 0 || written[i - 1] == ':', ends = i + 1 == written.size() || written[i + 1] == ':';
    if (c == '&' && starts && ends) {
      out += previous;
    } else if (c == '$') {
      out += environmentAt(written, i, unset);
    } else if (c == '~' && starts && (ends || written[i + 1] == '/')) {
      const char* home = std::getenv("HOME");
      out += home ? home : "~";
    } else if (!(c == '@' && starts && ends)) {
      out += c;
    }
  }
  return out;
}

DirMap readDirMap(const std::vector<std::string>& written) {
  const std::vector<std::string> words = written.size() == 1 ? quoted(written[0]) : written;
  DirMap out;
  for (size_t i = 0; i + 3 <= words.size(); i += 3) out.push_back({words[i], words[i + 1], words[i + 2]});
  return out;
}

std::string mapped(const std::string& name, const DirMap& map) {
  const auto fits = [&](const auto& entry) {
    return entry[0] == "NFS" && !entry[1].empty() && name.starts_with(entry[1]);
  };
  const auto it = std::find_if(map.begin(), map.end(), fits);
  return it == map.end() ? name : (*it)[2] + name.substr((*it)[1].size());
}

std::string mappedPath(const std::string& path, const DirMap& map) {
  std::string out;
  for (const std::string& folder : foldersOf(path)) {
    if (out.size() > kLongestSearchPath) break;
    out += (out.empty() ? "" : ":") + mapped(folder, map);
  }
  return out;
}

}  // namespace tomales::rib
