// Writes pictures for display drivers, as one more format.
#include <stdexcept>

#include "reyes/display_driver.h"
#include "reyes/image/format_writer.h"

namespace tomales {
namespace {

class DriverWriter : public FormatWriter {
 public:
  DriverWriter(const Image& shape, const FileFormat& format)
      : driver_(format.driver->plugin, pictureOf(shape, format)) {
    check(!driver_.failed());
  }

  void write(const Image& rows) override { check(driver_.write(rows)); }
  void close() override { check(driver_.close()); }
  std::vector<std::string> unread() const override { return driver_.unread(); }

 private:
  static DriverPicture pictureOf(const Image& shape, const FileFormat& format) {
    const auto& [plugin, display, view] = *format.driver;
    return {display.name,
            display.mode,
            shape.width,
            shape.height,
            shape.originX,
            shape.originY,
            shape.displayWidth > 0 ? shape.displayWidth : shape.width,
            shape.displayHeight > 0 ? shape.displayHeight : shape.height,
            format.pixelAspect,
            shape.channels,
            display.params,
            view};
  }
  void check(bool good) const {
    if (!good) throw std::runtime_error(driver_.error());
  }

  DisplayDriver driver_;
};

}  // namespace

const PictureFormat& driverFormat() {
  static const PictureFormat row = {
      .name = "display driver",
      .title = "a display driver",
      .floats = true,
      .open = [](const std::string&, const Image& shape, const FileFormat& format) -> std::unique_ptr<FormatWriter> {
        return std::make_unique<DriverWriter>(shape, format);
      }};
  return row;
}

}  // namespace tomales
