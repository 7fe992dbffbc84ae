// Changes of texts that several units need.
#pragma once
#include <cctype>
#include <filesystem>
#include <string>

namespace tomales {

/// Returns the text with ASCII letters in lower case.
inline std::string lowerCase(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Returns the extension of a file's name with its dot, in lower case ("Ball.OBJ": ".obj").
inline std::string endingOf(const std::filesystem::path& file) { return lowerCase(file.extension().string()); }

}  // namespace tomales
