// Changes of texts that several units need.
#pragma once
#include <cctype>
#include <string>

namespace tomales {

/// Returns the text with capital letters of ASCII made small.
inline std::string lowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace tomales
