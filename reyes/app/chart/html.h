// Pieces of pages that stand alone: their style, pictures inside the text, figures in words.
#pragma once
#include <string>

namespace tomales {

extern const char* const kPageStyle;
/// A PNG file as the address of an <img>.
std::string embedded(const std::string& png);
std::string percent(double share);
std::string megabytes(double bytes);
/// Under a temporary name first. False: it could not be written.
bool writeAtOnce(const std::string& path, const std::string& text);

}  // namespace tomales
