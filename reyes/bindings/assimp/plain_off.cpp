#include "reyes/bindings/assimp/plain_off.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>
#include <vector>

namespace tomales::model {
namespace {

using OffLine = std::vector<std::string>;

/// Lines of words, without comments and empty lines.
std::vector<OffLine> linesOf(const std::string& text) {
  std::vector<OffLine> out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line.substr(0, line.find('#')));
    OffLine all;
    for (std::string word; words >> word;) all.push_back(word);
    if (!all.empty()) out.push_back(std::move(all));
  }
  return out;
}

/// Returns the first word of a text, after comments.
std::string_view firstWord(std::string_view text) {
  constexpr const char* kSpace = " \t\r\n\v\f";
  size_t begin = text.find_first_not_of(kSpace);
  while (begin != text.npos && text[begin] == '#') begin = text.find_first_not_of(kSpace, text.find('\n', begin));
  if (begin == text.npos) return {};
  return text.substr(begin, text.find_first_of(" \t\r\n\v\f#", begin) - begin);
}

float numberIn(const std::string& word) { return std::strtof(word.c_str(), nullptr); }

}  // namespace

std::string plainOff(std::string text) {
  const std::string_view head = firstWord(text);  // Most files have no colours, and long lists.
  const bool hasNormals = head == "CNOFF";
  if (head != "COFF" && !hasNormals) return text;
  std::vector<OffLine> lines = linesOf(text);
  if (lines.size() < 2) return text;
  if (lines[0].size() == 1) {  // the counts follow on a line of their own
    lines[0].insert(lines[0].end(), lines[1].begin(), lines[1].end());
    lines.erase(lines.begin() + 1);
  }
  const size_t first = hasNormals ? 6 : 3,
               count = lines[0].size() > 1 ? std::strtoul(lines[0][1].c_str(), nullptr, 10) : 0,
               end = std::min(count, lines.size() - 1) + 1;
  float most = 1;
  for (size_t v = 1; v < end; ++v)
    for (size_t k = first; k < lines[v].size(); ++k) most = std::max(most, numberIn(lines[v][k]));
  const float unit = most > 1 ? 255 : 1;
  for (size_t v = 1; v < end; ++v) {
    OffLine& words = lines[v];
    for (size_t k = first; k < words.size(); ++k) words[k] = fmt::format("{}", numberIn(words[k]) / unit);
    if (words.size() == first + 3) words.emplace_back("1");
    if (hasNormals && words.size() > first) words.erase(words.begin() + 3, words.begin() + 6);
  }
  lines[0][0] = "COFF";
  std::string out;
  for (const OffLine& words : lines) out += fmt::format("{}\n", fmt::join(words, " "));
  return out;
}

}  // namespace tomales::model
