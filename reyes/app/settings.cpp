#include "reyes/app/settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

namespace tomales {
namespace {

constexpr int64_t kLeastCache = 1 << 20;

constexpr size_t kMostFrames = 1000000;

template <class T>
bool number(std::string_view text, T& out) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  return error == std::errc{} && end == text.data() + text.size();
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> out;
  for (size_t at; (at = text.find(separator)) != std::string_view::npos; text.remove_prefix(at + 1))
    out.push_back(text.substr(0, at));
  out.push_back(text);
  return out;
}

/// Appends "15", "1-10" or "1-10x2".
bool appendRange(std::string_view text, std::vector<int>& out) {
  int first = 0, last = 0, step = 1;
  const size_t cross = text.find('x');
  if (cross != std::string_view::npos && (!number(text.substr(cross + 1), step) || step < 1)) return false;
  text = text.substr(0, cross);
  const size_t dash = text.find('-', 1);
  if (!number(text.substr(0, dash), first)) return false;
  last = first;
  if (dash != std::string_view::npos && !number(text.substr(dash + 1), last)) return false;
  if (last < first) return false;
  for (int64_t frame = first; frame <= last; frame += step) {
    if (out.size() == kMostFrames) return false;
    out.push_back(static_cast<int>(frame));
  }
  return true;
}

}  // namespace

std::optional<std::array<int, 2>> parsePair(const std::string& text, int least, int most) {
  const auto parts = split(text, 'x');
  std::array<int, 2> out{};
  if (parts.size() != 2 || !number(parts[0], out[0]) || !number(parts[1], out[1])) return std::nullopt;
  const auto [low, high] = std::minmax(out[0], out[1]);
  if (low < least || high > most) return std::nullopt;
  return out;
}

std::optional<std::array<int, 2>> parsePixel(const std::string& text) {
  const auto parts = split(text, ',');
  std::array<int, 2> out;
  if (parts.size() != 2 || !number(parts[0], out[0]) || !number(parts[1], out[1])) return std::nullopt;
  return out;
}

std::optional<std::array<float, 4>> parseCrop(const std::string& text) {
  const auto parts = split(text, ',');
  std::array<float, 4> c{};
  if (parts.size() != 4) return std::nullopt;
  for (size_t i = 0; i < 4; ++i)
    if (!number(parts[i], c[i]) || !(c[i] >= 0 && c[i] <= 1)) return std::nullopt;
  if (c[0] >= c[1] || c[2] >= c[3]) return std::nullopt;
  return c;
}

std::optional<std::vector<int>> parseFrames(const std::string& text) {
  std::vector<int> out;
  if (text == "none") return out;
  for (const std::string_view part : split(text, ','))
    if (!appendRange(part, out)) return std::nullopt;
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::optional<int64_t> parseBytes(const std::string& text) {
  const std::string units = "KMGT";
  const size_t unit = text.empty() ? std::string::npos : units.find(text.back());
  int64_t value = 0;
  if (!number(std::string_view(text).substr(0, text.size() - (unit != std::string::npos)), value) || value < 1)
    return std::nullopt;
  const int shift = unit == std::string::npos ? 0 : 10 * (static_cast<int>(unit) + 1);
  if (value > (std::numeric_limits<int64_t>::max() >> shift)) return std::nullopt;
  return value << shift;
}

std::optional<double> parseShare(const std::string& text) {
  const bool percent = text.ends_with('%');
  double value = 0;
  if (!number(std::string_view(text).substr(0, text.size() - percent), value)) return std::nullopt;
  if (percent) value /= 100;
  return value > 0 && value < 1 ? std::optional(value) : std::nullopt;
}

std::optional<const GiMethod*> parseGi(const std::string& text) {
  const GiMethod* method = giMethodNamed(text);
  return method || text == "scene" ? std::optional(method) : std::nullopt;
}

std::optional<double> parseSeconds(const std::string& text) {
  const std::string units = "smh";
  const size_t unit = text.empty() ? std::string::npos : units.find(text.back());
  double value = 0;
  if (!number(std::string_view(text).substr(0, text.size() - (unit != std::string::npos)), value) ||
      !(value > 0 && std::isfinite(value)))
    return std::nullopt;
  return value * std::array{1, 60, 3600}[unit == std::string::npos ? 0 : unit];
}

int64_t textureShare(int64_t memoryLimit) { return std::max(kLeastCache, memoryLimit / 4); }

int64_t rayShare(int64_t memoryLimit) { return textureShare(memoryLimit); }

size_t brickCacheBytes(const ResourceSettings& settings) {
  if (!settings.memoryLimit) return settings.brickCacheBytes;
  return std::min(settings.brickCacheBytes, static_cast<size_t>(std::max(kLeastCache, *settings.memoryLimit / 8)));
}

std::string withFrameNumber(const std::string& path, int frame) {
  size_t parent = 0;  // of the folders that exist, a '#' is part of the name
  for (size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1))
    if (std::error_code ignored; std::filesystem::is_directory(path.substr(0, slash), ignored)) parent = slash;
  const size_t first = path.find('#', parent);
  if (first == std::string::npos) return path;
  const size_t last = std::min(path.find_first_not_of('#', first), path.size());
  std::string digits = std::to_string(frame);
  if (digits.size() < last - first) digits.insert(0, last - first - digits.size(), '0');
  return path.substr(0, first) + digits + path.substr(last);
}

}  // namespace tomales
