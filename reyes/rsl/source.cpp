#include "reyes/rsl/source.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "reyes/rsl/quote.h"

namespace tomales::compiler {
namespace {

constexpr size_t kMostQuoted = 60;
constexpr size_t kMostNameLength = 64;  ///< Longer words are nobody's misspelling.

bool isControl(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

/// Letters to insert, remove, change, or exchange with their neighbour.
size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<size_t> row(b.size() + 1), above, twoAbove;
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    twoAbove = std::exchange(above, row);
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t changed = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, changed});
      const bool exchanged = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (exchanged) row[j] = std::min(row[j], twoAbove[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::string quoted(std::string_view text) {
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
  if (wanted.size() > kMostNameLength) return {};
  // Of a short word one letter may be wrong, of a longer one a third.
  const size_t farthest = std::max<size_t>(1, wanted.size() / 3);
  std::vector<std::pair<size_t, const std::string*>> near;
  for (const std::string& name : known) {
    if (std::ranges::equal(name, wanted, [](char a, char b) { return std::tolower(a) == std::tolower(b); })) {
      near.emplace_back(0, &name);
      continue;
    }
    const size_t difference = name.size() > wanted.size() ? name.size() - wanted.size() : wanted.size() - name.size();
    if (difference > farthest) continue;
    const size_t distance = editDistance(wanted, name);
    if (distance <= farthest && distance < wanted.size()) near.emplace_back(distance, &name);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> out;
  for (const auto& [distance, name] : near)
    if (out.size() < most && std::find(out.begin(), out.end(), *name) == out.end()) out.push_back(*name);
  return out;
}

}  // namespace tomales::compiler
