#include "reyes/image/format_writer.h"

#include <cstring>
#include <stdexcept>

namespace tomales {
namespace {

template <class T>
void pack(const Image& rows, std::byte* out) {
  for (size_t i = 0; i < rows.pixels.size(); ++i) {
    const T value = static_cast<T>(rows.pixels[i]);
    std::memcpy(out + i * sizeof(T), &value, sizeof(T));
  }
}

}  // namespace

std::vector<std::byte> packed(const Image& rows, SampleType type) {
  const size_t bytes = type == SampleType::UInt8 ? 1 : type == SampleType::UInt16 ? 2 : 4;
  std::vector<std::byte> out(rows.pixels.size() * bytes);
  if (bytes == 1)
    pack<uint8_t>(rows, out.data());
  else if (bytes == 2)
    pack<uint16_t>(rows, out.data());
  else
    pack<float>(rows, out.data());
  return out;
}

void FormatWriter::write(const DeepRows&) { throw std::runtime_error("only OpenEXR holds deep pixels"); }

}  // namespace tomales
