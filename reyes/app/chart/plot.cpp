#include "reyes/app/chart/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reyes/app/chart/html.h"

namespace tomales {
namespace {

// Okabe and Ito's colours, which the colour-blind can tell apart, darkest first.
constexpr const char* kColors[] = {"#0072b2", "#d55e00", "#009e73", "#000000", "#cc79a7", "#e69f00", "#56b4e9"};
constexpr int kLeft = 58, kRight = 14, kTop = 14, kBottom = 44;

/// Ticks at round numbers.
struct LogAxis {
  double low = 1e300, high = 0;
  double begin = 0, end = 1;  ///< In pixels.

  void extend(double v) {
    if (!(v > 0)) return;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  void settle(double pixelBegin, double pixelEnd) {
    begin = pixelBegin;
    end = pixelEnd;
    if (high == 0) low = high = 1;
    low /= 1.25;
    high *= 1.25;
  }
  double at(double v) const {
    const double share = (std::log(std::clamp(v, low, high)) - std::log(low)) / (std::log(high) - std::log(low));
    return begin + share * (end - begin);
  }
  std::vector<double> ticks() const {
    std::vector<double> out;
    const std::vector<double> steps = high / low > 300 ? std::vector<double>{1}
                                      : high / low > 8 ? std::vector<double>{1, 2, 5}
                                                       : std::vector<double>{1, 1.2, 1.5, 2, 3, 4, 5, 6, 8};
    for (double decade = std::pow(10, std::floor(std::log10(low))); decade <= high; decade *= 10)
      for (const double step : steps)
        if (step * decade >= low && step * decade <= high) out.push_back(step * decade);
    return out;
  }
};

class Drawing : Markup {
 public:
  Drawing(const Plot& plot, int width, int height) : plot_(plot), width_(width), height_(height) {
    for (const PlotCurve& curve : plot.curves)
      for (const PlotPoint& p : curve.points) {
        x_.extend(p.x);
        y_.extend(p.y);
      }
    y_.extend(plot.floor);
    x_.extend(plot.limit);
    x_.settle(kLeft, width - kRight);
    y_.settle(height - kBottom, kTop);
  }

  std::string draw() {
    put("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", width_, height_, escapeXml(plot_.title));
    axes();
    floor();
    limit();
    front();
    for (size_t c = 0; c < plot_.curves.size(); ++c) curve(c);
    put("</svg>\n");
    return take();
  }

 private:
  void axes() {
    const double bottom = height_ - kBottom, right = width_ - kRight;
    for (const double t : x_.ticks()) {
      put("<path class=\"grid\" d=\"M{0:.1f} {1}V{2:.1f}\"/>", x_.at(t), kTop, bottom);
      put("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", x_.at(t), bottom + 16,
          shortNumber(t));
    }
    for (const double t : y_.ticks()) {
      put("<path class=\"grid\" d=\"M{} {:.1f}H{:.1f}\"/>", kLeft, y_.at(t), right);
      put("<text class=\"tick\" x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{} %</text>\n", kLeft - 6, y_.at(t) + 4,
          shortNumber(100 * t));
    }
    put("<path class=\"axis\" d=\"M{} {}V{}H{}\"/>\n", kLeft, kTop, bottom, right);
    put("<text class=\"label\" x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", (kLeft + right) / 2, height_ - 8,
        escapeXml(plot_.xLabel));
    put("<text class=\"label\" transform=\"translate(12 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (kTop + bottom) / 2, escapeXml(plot_.yLabel));
  }

  void floor() {
    if (!(plot_.floor > 0)) return;
    put("<path class=\"floor\" d=\"M{} {:.1f}H{}\"/>", kLeft, y_.at(plot_.floor), width_ - kRight);
    put("<text class=\"floor\" x=\"{}\" y=\"{:.1f}\" >noise of the reference</text>\n", kLeft + 6,
        y_.at(plot_.floor) - 5);
  }

  void limit() {
    if (!(plot_.limit > 0)) return;
    const double x = x_.at(plot_.limit);
    const bool leftHalf = x < 0.5 * (kLeft + width_ - kRight);
    put("<path class=\"limit\" d=\"M{:.1f} {}V{}\"/>", x, kTop, height_ - kBottom);
    put("<text class=\"limit\" x=\"{:.1f}\" y=\"{}\" text-anchor=\"{}\">{}</text>\n", leftHalf ? x + 5 : x - 5,
        height_ - kBottom - 6, leftHalf ? "start" : "end", escapeXml(plot_.limitName));
  }

  /// Draws a band under the points that no other point beats.
  void front() {
    std::vector<const PlotPoint*> best;
    for (const PlotCurve& curve : plot_.curves)
      for (const PlotPoint& p : curve.points)
        if (p.best) best.push_back(&p);
    std::sort(best.begin(), best.end(), [](const PlotPoint* a, const PlotPoint* b) { return a->x < b->x; });
    put("<path class=\"front\" d=\"");
    for (const PlotPoint* p : best) put("{}{:.1f} {:.1f}", p == best.front() ? "M" : "L", x_.at(p->x), y_.at(p->y));
    put("\"/>\n");
  }

  void curve(size_t c) {
    const PlotCurve& curve = plot_.curves[c];
    put("<path class=\"curve\" stroke=\"{}\" d=\"", plotColor(c));
    for (const PlotPoint& p : curve.points)
      put("{}{:.1f} {:.1f}", &p == &curve.points.front() ? "M" : "L", x_.at(p.x), y_.at(p.y));
    put("\"/>\n");
    for (const PlotPoint& p : curve.points) {
      if (p.interval > 0)
        put("<path class=\"whisker\" stroke=\"{}\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", plotColor(c), x_.at(p.x),
            y_.at(std::max(p.y - p.interval, 1e-12)), y_.at(p.y + p.interval));
      if (p.warned) put("<circle class=\"warned\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8.5\"/>", x_.at(p.x), y_.at(p.y));
      put("<a href=\"{}\"><circle class=\"{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"5\" "
          "fill=\"{}\"><title>{}</title></circle></a>\n",
          escapeXml(p.link), p.best ? "point best" : "point", x_.at(p.x), y_.at(p.y), plotColor(c), escapeXml(p.tip));
      if (!p.name.empty()) name(p);
    }
  }

  /// Writes the name to the right or, where the drawing ends, to the left.
  void name(const PlotPoint& p) {
    const bool left = x_.at(p.x) > width_ - kRight - 10 - 7 * static_cast<double>(p.name.size());
    put("<text class=\"name\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x_.at(p.x) + (left ? -8 : 8),
        y_.at(p.y) - 5, left ? "end" : "start", escapeXml(p.name));
  }

  const Plot& plot_;
  const int width_, height_;
  LogAxis x_, y_;
};

}  // namespace

const char* plotColor(size_t curve) { return kColors[curve % std::size(kColors)]; }

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

std::string drawDifferences(const std::string& title, const std::vector<PlotDifference>& rows, int width) {
  constexpr int kRow = 26, kNames = 190, kEnd = 170, kSize = 13;
  Markup out;
  double low = 0, high = 0;
  for (const PlotDifference& r : rows) {
    low = std::min(low, r.mean - r.interval);
    high = std::max(high, r.mean + r.interval);
  }
  const double scale = (width - kNames - kEnd) / std::max(high - low, 1e-12);
  const auto at = [&](double v) { return kNames + (v - low) * scale; };
  const int height = kRow * static_cast<int>(rows.size()) + kSize;
  out.put("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n", width, height, escapeXml(title));
  out.put("<path class=\"axis\" d=\"M{:.1f} 4V{}\"/>\n", at(0), height - 4);
  for (size_t i = 0; i < rows.size(); ++i) {
    const PlotDifference& r = rows[i];
    const int y = kRow * static_cast<int>(i) + kRow / 2 + 4;
    out.put("<text class=\"label\" x=\"0\" y=\"{}\">{}</text>", y + 4, escapeXml(r.name));
    out.put("<path class=\"whisker\" stroke=\"{}\" d=\"M{:.1f} {}H{:.1f}\"/>", plotColor(r.curve),
            at(r.mean - r.interval), y, at(r.mean + r.interval));
    out.put("<circle class=\"point\" cx=\"{:.1f}\" cy=\"{}\" r=\"5\" fill=\"{}\"/>", at(r.mean), y, plotColor(r.curve));
    out.put("<text class=\"tick\" x=\"{}\" y=\"{}\">{} &#177; {}</text>\n", width - kEnd + 14, y + 4, percent(r.mean),
            percent(r.interval));
  }
  out.put("</svg>\n");
  return out.take();
}

std::string drawPlot(const Plot& plot, int width, int height) { return Drawing(plot, width, height).draw(); }

}  // namespace tomales
