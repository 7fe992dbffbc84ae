// The mode of a Display: which channels it shows.
#pragma once
#include <string>
#include <vector>

namespace tomales {

/// Returns the names in a mode, which commas or blanks separate.
inline std::vector<std::string> channelNames(const std::string& mode) {
  std::vector<std::string> out{""};
  for (const char c : mode)
    if (c == ',' || c == ' ')
      out.emplace_back();
    else
      out.back() += c;
  std::erase(out, "");
  return out;
}

/// Tells whether a mode names the colour, opacity or depth of the picture by letters, as "rgba" does.
inline bool isOfLetters(const std::string& mode) {
  return !mode.empty() && mode.find_first_not_of("rgbaz") == std::string::npos;
}

}  // namespace tomales
