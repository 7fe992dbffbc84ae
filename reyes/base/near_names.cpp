#include "reyes/base/near_names.h"

#include <algorithm>
#include <utility>

#include "reyes/base/text.h"

namespace tomales {
namespace {

constexpr size_t kMostNameLength = 64;  ///< A longer word is not taken for a misspelling.

/// Returns the number of letters to insert, remove, change, or exchange with their neighbour.
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

std::vector<std::string> nearNames(std::string_view wanted, const std::vector<std::string>& known, size_t most) {
  if (wanted.size() > kMostNameLength) return {};
  // One letter may be wrong in a short word, and a third of the letters in a longer one.
  const size_t farthest = std::max<size_t>(1, wanted.size() / 3);
  std::vector<std::pair<size_t, const std::string*>> near;
  for (const std::string& name : known) {
    const size_t difference = name.size() > wanted.size() ? name.size() - wanted.size() : wanted.size() - name.size();
    if (difference > farthest) continue;
    const size_t distance = editDistance(lowerCase(std::string(wanted)), lowerCase(name));
    if (distance <= farthest && distance < wanted.size()) near.emplace_back(distance, &name);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> out;
  for (const auto& [distance, name] : near)
    if (out.size() < most && std::find(out.begin(), out.end(), *name) == out.end()) out.push_back(*name);
  return out;
}

std::string didYouMean(std::string_view wanted, const std::vector<std::string>& known) {
  const std::vector<std::string> near = nearNames(wanted, known);
  return near.empty() ? "" : "; did you mean \"" + near.front() + "\"?";
}

}  // namespace tomales
