// The module over libtiff: only this file includes that library, which brings those of other formats.
#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <stdexcept>

#include "reyes/image/format_writer.h"
#include "reyes/image/tiff_module.h"

namespace tomales {
namespace {

int bitsOf(SampleType type) { return type == SampleType::UInt8 ? 8 : type == SampleType::UInt16 ? 16 : 32; }

uint16_t compressionOf(const FileFormat& format) {
  if (format.compression == "none") return COMPRESSION_NONE;
  if (format.compression == "rle") return COMPRESSION_PACKBITS;
  if (format.compression == "zip" || format.compression == "zips") return COMPRESSION_ADOBE_DEFLATE;
  return COMPRESSION_LZW;
}

int keepMessage(TIFF*, void* problem, const char*, const char* form, va_list arguments) {
  char text[256];
  std::vsnprintf(text, sizeof text, form, arguments);
  *static_cast<std::string*>(problem) = text;
  return 1;
}

int ignoreMessage(TIFF*, void*, const char*, const char*, va_list) { return 1; }

class TiffFile : public FormatWriter {
 public:
  TiffFile(const std::string& path, const Image& shape, const FileFormat& format) : format_(format) {
    TIFFOpenOptions* options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options, keepMessage, &problem_);
    TIFFOpenOptionsSetWarningHandlerExtR(options, ignoreMessage, nullptr);
    // Offsets of a classic file have 32 bits, and compression may also make a picture larger.
    const double bytes = double(shape.width) * shape.height * shape.channelCount() * bitsOf(format.type) / 8;
    file_ = TIFFOpenExt(path.c_str(), bytes > 2e9 ? "w8" : "w", options);
    TIFFOpenOptionsFree(options);
    check(file_);
    setLayout(shape);
    setWindow(shape);
    TIFFSetField(file_, TIFFTAG_SOFTWARE, "Tomales");
  }
  ~TiffFile() override {
    if (file_) TIFFClose(file_);
  }

  void write(const Image& rows) override {
    std::vector<std::byte> bytes = packed(rows, format_.type);
    const size_t row = bytes.size() / static_cast<size_t>(rows.height);
    for (int y = 0; y < rows.height; ++y)
      check(TIFFWriteScanline(file_, bytes.data() + static_cast<size_t>(y) * row, row_++, 0) == 1);
  }

  void close() override {
    check(TIFFFlush(file_) == 1);
    TIFFClose(std::exchange(file_, nullptr));
  }

 private:
  void check(bool good) const {
    if (!good) throw std::runtime_error("TIFF: " + (problem_.empty() ? "it cannot be written" : problem_));
  }

  void setLayout(const Image& shape) {
    const int channels = shape.channelCount(), colours = channels >= 3 ? 3 : 1;
    TIFFSetField(file_, TIFFTAG_IMAGEWIDTH, shape.width);
    TIFFSetField(file_, TIFFTAG_IMAGELENGTH, shape.height);
    TIFFSetField(file_, TIFFTAG_SAMPLESPERPIXEL, channels);
    TIFFSetField(file_, TIFFTAG_BITSPERSAMPLE, bitsOf(format_.type));
    TIFFSetField(file_, TIFFTAG_SAMPLEFORMAT, bitsOf(format_.type) == 32 ? SAMPLEFORMAT_IEEEFP : SAMPLEFORMAT_UINT);
    TIFFSetField(file_, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    TIFFSetField(file_, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    TIFFSetField(file_, TIFFTAG_PHOTOMETRIC, colours == 3 ? PHOTOMETRIC_RGB : PHOTOMETRIC_MINISBLACK);
    std::vector<uint16_t> extra;
    for (int c = colours; c < channels; ++c)
      extra.push_back(shape.channels[static_cast<size_t>(c)] != "A" ? EXTRASAMPLE_UNSPECIFIED
                      : format_.unassociatedAlpha                   ? EXTRASAMPLE_UNASSALPHA
                                                                    : EXTRASAMPLE_ASSOCALPHA);
    if (!extra.empty()) TIFFSetField(file_, TIFFTAG_EXTRASAMPLES, static_cast<uint16_t>(extra.size()), extra.data());
    const uint16_t compression = compressionOf(format_);
    TIFFSetField(file_, TIFFTAG_COMPRESSION, compression);
    if (compression == COMPRESSION_LZW || compression == COMPRESSION_ADOBE_DEFLATE)
      TIFFSetField(file_, TIFFTAG_PREDICTOR,
                   bitsOf(format_.type) == 32 ? PREDICTOR_FLOATINGPOINT : PREDICTOR_HORIZONTAL);
    TIFFSetField(file_, TIFFTAG_ROWSPERSTRIP, PictureFile::kBandRows);
  }

  /// Positions in TIFF are in units of the resolution, which is set so that a unit is one pixel's width. TIFF has no
  /// negative positions.
  void setWindow(const Image& shape) {
    TIFFSetField(file_, TIFFTAG_RESOLUTIONUNIT, RESUNIT_NONE);
    TIFFSetField(file_, TIFFTAG_XRESOLUTION, 1.0f);
    TIFFSetField(file_, TIFFTAG_YRESOLUTION, format_.pixelAspect);
    TIFFSetField(file_, TIFFTAG_XPOSITION, static_cast<float>(std::max(shape.originX, 0)));
    TIFFSetField(file_, TIFFTAG_YPOSITION, static_cast<float>(std::max(shape.originY, 0)) / format_.pixelAspect);
    TIFFSetField(file_, TIFFTAG_PIXAR_IMAGEFULLWIDTH, shape.displayWidth > 0 ? shape.displayWidth : shape.width);
    TIFFSetField(file_, TIFFTAG_PIXAR_IMAGEFULLLENGTH, shape.displayHeight > 0 ? shape.displayHeight : shape.height);
  }

  const FileFormat format_;
  std::string problem_;
  TIFF* file_ = nullptr;
  uint32_t row_ = 0;
};

}  // namespace
}  // namespace tomales

extern "C" __attribute__((visibility("default"))) std::unique_ptr<tomales::FormatWriter> tomalesOpenTiff(
    const std::string& path, const tomales::Image& shape, const tomales::FileFormat& format) {
  return std::make_unique<tomales::TiffFile>(path, shape, format);
}
