#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "reyes/image/format_writer.h"
#include "reyes/image_files.h"

namespace tomales {
namespace {

void keepMessage(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

struct Handles {
  ~Handles() {
    png_destroy_write_struct(&png, &info);
    if (stream) std::fclose(stream);
  }
  std::FILE* stream = nullptr;
  png_structp png = nullptr;
  png_infop info = nullptr;
};

/// One to four channels of integers.
class PngFile : public FormatWriter {
 public:
  PngFile(const std::string& path, const Image& shape, const FileFormat& format) : format_(format) {
    static constexpr int kColours[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                       PNG_COLOR_TYPE_RGB_ALPHA};
    const int channels = shape.channelCount();
    if (channels < 1 || channels > 4)
      throw std::runtime_error(fmt::format("PNG holds 1 to 4 channels, not {}", channels));
    file_.stream = std::fopen(path.c_str(), "wb");
    if (!file_.stream) throw std::runtime_error(std::strerror(errno));
    file_.png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &problem_, keepMessage, [](png_structp, png_const_charp) {});
    file_.info = png_create_info_struct(file_.png);
    if (!file_.info) throw std::runtime_error("PNG: out of memory");
    guarded([&] {
      png_init_io(file_.png, file_.stream);
      png_set_IHDR(file_.png, file_.info, static_cast<png_uint_32>(shape.width), static_cast<png_uint_32>(shape.height),
                   format_.type == SampleType::UInt16 ? 16 : 8, kColours[channels - 1], PNG_INTERLACE_NONE,
                   PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
      if (shape.originX != 0 || shape.originY != 0)
        png_set_oFFs(file_.png, file_.info, shape.originX, shape.originY, PNG_OFFSET_PIXEL);
      constexpr float kUnits = 1000;  // pixels across, in an arbitrary unit
      if (format_.pixelAspect != 1)
        png_set_pHYs(file_.png, file_.info, static_cast<png_uint_32>(kUnits),
                     static_cast<png_uint_32>(std::lround(kUnits * format_.pixelAspect)), PNG_RESOLUTION_UNKNOWN);
      char key[] = "Software", text[] = "Tomales";
      png_text software{};
      software.compression = PNG_TEXT_COMPRESSION_NONE;
      software.key = key;
      software.text = text;
      png_set_text(file_.png, file_.info, &software, 1);
      png_write_info(file_.png, file_.info);
      if (std::endian::native == std::endian::little) png_set_swap(file_.png);
    });
  }

  void write(const Image& rows) override {
    const std::vector<std::byte> bytes = packed(rows, format_.type);
    const size_t row = bytes.size() / static_cast<size_t>(rows.height);
    guarded([&] {
      for (size_t at = 0; at < bytes.size(); at += row)
        png_write_row(file_.png, reinterpret_cast<png_const_bytep>(bytes.data() + at));
    });
  }

  void close() override {
    guarded([&] { png_write_end(file_.png, file_.info); });
    if (std::fclose(std::exchange(file_.stream, nullptr)) != 0) throw std::runtime_error(std::strerror(errno));
  }

 private:
  /// libpng reports errors by longjmp, so no local of `calls` may need a destructor.
  template <class Calls>
  void guarded(const Calls& calls) {
    if (setjmp(png_jmpbuf(file_.png))) throw std::runtime_error("PNG: " + problem_);
    calls();
  }

  const FileFormat format_;
  std::string problem_;
  Handles file_;
};

}  // namespace

const PictureFormat& pngFormat() {
  static const PictureFormat row = {.name = "png",
                                    .title = "PNG",
                                    .extensions = {".png"},
                                    .compressions = {"zip"},
                                    .quantises = true,
                                    .dividesColor = true,
                                    .isForScreens = true,
                                    .open = [](const std::string& path, const Image& shape,
                                               const FileFormat& format) -> std::unique_ptr<FormatWriter> {
                                      return std::make_unique<PngFile>(path, shape, format);
                                    }};
  return row;
}

}  // namespace tomales
