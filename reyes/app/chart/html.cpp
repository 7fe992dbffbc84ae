#include "reyes/app/chart/html.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <fstream>

#include "reyes/app/page_files.h"

namespace tomales {
namespace {

std::string base64(const std::string& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (size_t k = 0; k < 3; ++k)
      group = group << 8 | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0U);
    for (size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

}  // namespace

void Markup::openPage(const std::string& title, const std::string& heading, const std::string& style) {
  put("<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n");
  put("<title>{}</title><style>{}{}</style></head><body>\n<h1>{}</h1>\n", escapeXml(title), chartFile("style.css"),
      style, escapeXml(heading));
}

std::string_view chartFile(std::string_view name) {
  for (const PageFile& file : chartPage())
    if (file.name == name) return file.text;
  std::abort();  // CMake put it there.
}

std::string pictureTools(float white) {
  return fmt::format("<section id=\"viewer\" data-white=\"{}\">{}</section><script>{}</script>\n", white,
                     chartFile("pictures.html"), chartFile("pictures.js"));
}

std::string embedded(const std::string& png) {
  std::ifstream file(png, std::ios::binary);
  return "data:image/png;base64," + base64({std::istreambuf_iterator<char>(file), {}});
}

std::string shortNumber(double v) {
  if (!std::isfinite(v)) return "-";
  const double a = std::abs(v);
  return a != 0 && (a < 1e-4 || a >= 1e7) ? fmt::format("{:.2e}", v)
         : a >= 100                       ? fmt::format("{:.0f}", v)
                                          : fmt::format("{:.3g}", v);
}

std::string escapeXml(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string percent(double share) { return shortNumber(100 * share) + " %"; }
std::string megabytes(double bytes) { return fmt::format("{:.0f} MB", bytes / 1048576); }

}  // namespace tomales
