// Pieces of pages that stand alone: their style, pictures inside the text, figures in words.
#pragma once
#include <fmt/format.h>

#include <iterator>
#include <string>

namespace tomales {

/// What a page or a drawing is written to, piece by piece.
class Markup {
 public:
  template <class... T>
  void put(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<T>(values)...);
  }
  /// A page's head, and its body as far as the heading. style: beside that of all pages.
  void openPage(const std::string& title, const std::string& heading, const std::string& style = "");
  void closePage() { put("</body></html>\n"); }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
};

/// A PNG file as the address of an <img>.
std::string embedded(const std::string& png);
std::string percent(double share);
std::string megabytes(double bytes);

}  // namespace tomales
