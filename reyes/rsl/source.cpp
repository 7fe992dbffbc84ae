#include "reyes/rsl/source.h"

#include <fmt/format.h>

#include "reyes/base/near_names.h"
#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

constexpr size_t kMostQuoted = 60;

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

std::string inQuotes(std::string_view text) {
  std::string out = "'";
  for (const char c : text.substr(0, kMostQuoted)) out += isControl(c) ? '?' : c;
  return out + (text.size() > kMostQuoted ? "...'" : "'");
}

int32_t Sources::addFile(SourceFile file) {
  files_.push_back(std::move(file));
  std::vector<size_t>& starts = lineStarts_.emplace_back(1, size_t{0});
  const std::string& text = files_.back().text;
  for (size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1)) starts.push_back(at + 1);
  return static_cast<int32_t>(files_.size() - 1);
}

int32_t Sources::addExpansion(Expansion expansion) {
  expansions_.push_back(std::move(expansion));
  return static_cast<int32_t>(expansions_.size() - 1);
}

std::string_view Sources::line(int32_t file, int32_t line) const {
  if (file < 0 || static_cast<size_t>(file) >= files_.size() || line < 1) return {};
  const std::vector<size_t>& starts = lineStarts_[static_cast<size_t>(file)];
  if (static_cast<size_t>(line) > starts.size()) return {};
  const std::string_view text = files_[static_cast<size_t>(file)].text;
  const size_t begin = starts[static_cast<size_t>(line - 1)];
  return text.substr(begin, text.find('\n', begin) - begin);
}

Place Sources::outermost(Place place) const {
  while (place.expansion >= 0) place = expansion(place.expansion).use;
  return place;
}

std::string Sources::text(Place place) const {
  const std::string path = place.file < 0 ? "<command line>" : file(place.file).path;
  return place.line == 0 ? path : fmt::format("{}:{}:{}", path, place.line, place.column);
}

std::vector<std::string> nearNames(std::string_view wanted, const std::vector<std::string>& known, size_t most) {
  return tomales::nearNames(wanted, known, most);
}

}  // namespace tomales::compiler
