#include "gi/radiosity_picture.h"

#include <bit>
#include <numeric>

namespace tomales {
// Charts are sorted by height and then by width, both descending. So every row of charts, and every chart in it, begins
// at a multiple of its own size.
ChartLayout layOutPicture(const std::vector<RadiosityChart>& charts) {
  std::vector<size_t> order(charts.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return charts[a].height != charts[b].height ? charts[a].height > charts[b].height
                                                : charts[a].width > charts[b].width;
  });
  int64_t area = 0;
  int widest = 1;
  for (const RadiosityChart& c : charts) {
    area += static_cast<int64_t>(c.width) * c.height;
    widest = std::max(widest, c.width);
  }
  ChartLayout out;
  out.corner.resize(charts.size());
  out.width =
      std::max(widest, static_cast<int>(std::bit_ceil(static_cast<uint64_t>(std::sqrt(static_cast<double>(area))))));
  int x = 0, y = 0, rowHeight = 0;
  for (const size_t i : order) {
    const RadiosityChart& c = charts[i];
    if (x + c.width > out.width || c.height != rowHeight) {
      y += rowHeight;
      x = 0;
      rowHeight = c.height;
    }
    out.corner[i] = {x, y};
    x += c.width;
  }
  out.height = static_cast<int>(std::bit_ceil(static_cast<uint32_t>(y + rowHeight)));
  return out;
}

Image pictureOf(const std::vector<RadiosityChart>& charts) {
  const ChartLayout layout = layOutPicture(charts);
  Image out;
  out.width = out.displayWidth = layout.width;
  out.height = out.displayHeight = layout.height;
  out.channels = {"R", "G", "B"};
  out.pixels.assign(static_cast<size_t>(out.width) * static_cast<size_t>(out.height) * 3, 0.0f);
  for (size_t i = 0; i < charts.size(); ++i) {
    const RadiosityChart& c = charts[i];
    for (int y = 0; y < c.height; ++y)
      for (int x = 0; x < c.width; ++x)
        for (int k = 0; k < 3; ++k)
          out.at(layout.corner[i].x + x, layout.corner[i].y + y)[k] = c.texels[static_cast<size_t>(y * c.width + x)][k];
  }
  return out;
}

}  // namespace tomales
