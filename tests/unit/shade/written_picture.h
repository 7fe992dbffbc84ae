// Pictures that tests make for shaders to look up. OpenEXR writes them, not OpenImageIO: a program that is linked with
// that library takes half a CPU second to start, and ctest starts one for each suite.
#pragma once
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMatrixAttribute.h>
#include <OpenEXR/ImfOutputFile.h>

#include <array>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <string>
#include <vector>

#include "reyes/base/math.h"

namespace tomales {

/// Writes float channels of these one-letter names, from texel(x, y), a std::array of at least as many values. The
/// matrices become attributes of the file. Returns the path.
template <class Texel>
std::string writePicture(const std::string& path, int width, int height, const std::string& channels,
                         const Texel& texel, const std::map<std::string, mat4>& matrices = {}) {
  const size_t count = channels.size();
  std::vector<float> values;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto at = texel(x, y);
      values.insert(values.end(), at.begin(), at.begin() + static_cast<std::ptrdiff_t>(count));
    }
  Imf::Header header(width, height);
  for (const auto& [name, m] : matrices) {
    Imath::M44f matrix;
    std::copy_n(glm::value_ptr(m), 16, &matrix.x[0][0]);
    header.insert(name, Imf::M44fAttribute(matrix));
  }
  Imf::FrameBuffer buffer;
  for (size_t c = 0; c < count; ++c) {
    const std::string name(1, channels[c]);
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    const size_t pixel = count * sizeof(float);
    buffer.insert(
        name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&values[c]), pixel, pixel * static_cast<size_t>(width)));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(buffer);
  file.writePixels(height);
  return path;
}

}  // namespace tomales
