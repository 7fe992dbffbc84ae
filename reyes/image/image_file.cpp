#include "reyes/image/image_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "reyes/base/unfinished_file.h"
#include "reyes/image/format_writer.h"
#include "reyes/image_files.h"
#include "reyes/pictures.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// Overwrites a text in all headers of an OpenEXR file by one of the same length, because a header is written before
/// the pixels, when their statistics are not known yet. An attribute is its name, its type, the number of its bytes,
/// and these bytes. Returns whether the file has it.
bool overwrite(int file, const std::string& name, const std::string& old, const std::string& text) {
  constexpr size_t kMostHeaderBytes = 16 << 20;
  std::string head(kMostHeaderBytes, '\0');
  const ssize_t size = ::pread(file, head.data(), head.size(), 0);
  head.resize(size > 0 ? static_cast<size_t>(size) : 0);
  std::string before = name + std::string("\0string\0", 8);
  for (int shift = 0; shift < 32; shift += 8) before += static_cast<char>(old.size() >> shift & 0xff);
  bool any = false;
  for (size_t at = head.find(before + old); at != std::string::npos; at = head.find(before + old, at + 1)) {
    if (::pwrite(file, text.data(), text.size(), static_cast<off_t>(at + before.size())) != std::ssize(text))
      return false;
    any = true;
  }
  return any;
}

void tellShare(int file, float finished) {
  overwrite(file, kFinishedShare, kAllFinished, fmt::format("{:.3f}", std::min(finished, 0.999f)));
}

}  // namespace

bool fillStatistics(const std::string& file, const std::string& text) {
  if (text.size() > kStatisticsRoom) return false;
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return false;
  const std::string blanks(kStatisticsRoom, ' ');
  const bool done = overwrite(descriptor, kStatistics, blanks, text + blanks.substr(text.size()));
  ::close(descriptor);
  return done;
}

struct PictureFile::Impl {
  Impl(const std::string& target, const Image& whole, const FileFormat& f)
      : path(target),
        file(f.driver ? nullptr : UnfinishedFile::create(path, UnfinishedKind::Scratch, problem)),
        shape(whole),
        format(f) {
    const bool ready = f.driver || file;
    failed = !ready || !guarded([&] { writer = format.kind->open(file ? file->path() : path, shape, format); });
  }

  template <class Rows>
  bool write(const Rows& rows) {
    return guarded([&] { writer->write(rows); });
  }

  bool close(float finished) {
    if (failed || !guarded([&] { writer->close(); })) return false;
    const bool whole = finished >= 1;
    std::string why;
    if (file && !whole) {
      tellShare(file->descriptor(), finished);
      file->finishAs(partialName(path));
    }
    std::error_code none;  // there may be no such file
    if (file && whole) fs::remove(throughLinks(path).replace_filename(partialName(path)), none);
    return !file || file->finish(why) || fail(why);
  }

  template <class Write>
  bool guarded(const Write& write) {
    try {
      write();
      return true;
    } catch (const std::exception& e) {
      return fail(e.what());
    }
  }
  bool fail(const std::string& why) {
    if (!failed) problem = why;
    failed = true;
    return false;
  }

  const std::string path;
  std::string problem;                         // declared before `file`, whose opening sets it
  const std::unique_ptr<UnfinishedFile> file;  // null if a driver takes the picture
  const Image shape;
  const FileFormat format;
  std::unique_ptr<FormatWriter> writer;
  bool failed = false;
};

PictureFile::PictureFile(const std::string& path, const Image& shape, const FileFormat& format)
    : impl_(new Impl(path, shape, format)) {}

PictureFile::~PictureFile() = default;

bool PictureFile::write(const Image& rows) { return !impl_->failed && impl_->write(rows); }
bool PictureFile::write(const DeepRows& rows) { return !impl_->failed && impl_->write(rows); }
bool PictureFile::close(float finished) { return impl_->close(finished); }
const std::string& PictureFile::error() const { return impl_->problem; }
std::vector<std::string> PictureFile::unread() const {
  return impl_->writer ? impl_->writer->unread() : std::vector<std::string>();
}

Making copyShadowMap(const std::string& from, const std::string& to, std::string& error) {
  {
    const auto in = openPicture(from, error);
    float matrix[16];
    if (!in) return Making::Unreadable;
    const std::vector<std::string>& channels = in->shape().channels;
    if (std::find(channels.begin(), channels.end(), "Z") == channels.end() || !in->matrix("worldtocamera", matrix)) {
      error = "it is no shadow map: depth or the matrices of its camera are missing";
      return Making::Unreadable;
    }
  }
  std::error_code problem;
  if (fs::equivalent(from, to, problem)) return Making::Done;
  const auto file = UnfinishedFile::create(to, UnfinishedKind::Scratch, error);
  if (!file) return Making::Unwritable;
  fs::copy_file(from, file->path(), fs::copy_options::overwrite_existing, problem);
  if (!problem) return file->finish(error) ? Making::Done : Making::Unwritable;
  error = problem.message();
  return Making::Unwritable;
}

std::optional<Image> readImage(const std::string& path, std::string& error) {
  const auto in = openPicture(path, error);
  if (!in) return std::nullopt;
  const PictureShape& s = in->shape();
  Image image{s.width, s.height, s.channels, {}, s.x, s.y, s.fullWidth, s.fullHeight};
  image.pixels.resize(static_cast<size_t>(s.width) * static_cast<size_t>(s.height) * s.channels.size());
  if (!in->read(0, image.channelCount(), image.pixels.data())) {
    error = in->error();
    return std::nullopt;
  }
  return image;
}

int Image::channelIndex(const std::string& name) const {
  const auto it = std::find(channels.begin(), channels.end(), name);
  return it == channels.end() ? -1 : static_cast<int>(it - channels.begin());
}

}  // namespace tomales
