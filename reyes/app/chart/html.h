// Pieces of HTML pages that need no other files: their style, embedded pictures, figures in words.
#pragma once
#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

namespace tomales {

/// Collects a page or a drawing, piece by piece.
class Markup {
 public:
  template <class... T>
  void put(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...);
  }
  /// Writes a page's head, and its body up to the heading. `style` is added to that of all pages.
  void openPage(const std::string& title, const std::string& heading, const std::string& style = "");
  void closePage() { put("</body></html>\n"); }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

/// Returns markup with tools for the pictures of class "picture", whose names are in `data-name`. A slider sets the
/// exposure of all of them, in linear light. Two that are chosen take turns in one place. `white` is the value that is
/// white in the files.
std::string pictureTools(float white);

/// Returns a file of reyes/app/chart/page, or Chart.js.
std::string_view chartFile(std::string_view name);

/// Returns a PNG file as the address of an <img>.
std::string embedded(const std::string& png);
/// Writes three digits, without an exponent where possible.
std::string shortNumber(double value);
std::string escapeXml(const std::string& text);
std::string percent(double share);
std::string megabytes(double bytes);

}  // namespace tomales
