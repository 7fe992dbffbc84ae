#include "reyes/base/unfinished_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIsStream = "it is a pipe or a device, and no file that can be replaced";
constexpr int kMostLinks = 40;  ///< The same limit as Linux has.

bool failedWith(int number, std::string& error) {
  error = std::strerror(number);
  return false;
}

/// Links in these folders lead to open files, and cannot be followed by name.
bool isOfProcesses(const fs::path& path) {
  std::error_code none;
  const fs::path folder = fs::canonical(path.parent_path().empty() ? "." : path.parent_path(), none);
  return folder.string().starts_with("/proc/");
}

bool isStream(const fs::path& target) {
  std::error_code none;
  const fs::file_status status = fs::status(target, none);
  return isOfProcesses(throughLinks(target)) || (fs::exists(status) && !fs::is_regular_file(status));
}

/// Writes a file back to its disk. EINVAL is no failure: pipes and devices have nothing to write back.
bool writtenBack(int descriptor) { return ::fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP; }

/// Tells whether this is still the file of that name.
bool isNamed(int descriptor, const std::string& path) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::lstat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

}  // namespace

fs::path throughLinks(const fs::path& target) {
  fs::path out = target;
  std::error_code none;
  for (int i = 0; i < kMostLinks && fs::is_symlink(out, none) && !isOfProcesses(out); ++i)
    out = out.parent_path() / fs::read_symlink(out, none);
  return out;
}

std::unique_ptr<UnfinishedFile> UnfinishedFile::create(const std::string& target, UnfinishedKind kind,
                                                       std::string& error) {
  std::unique_ptr<UnfinishedFile> file(new UnfinishedFile);
  std::error_code none;
  file->target_ = throughLinks(target);
  const auto refused = [&](const char* why) {
    error = why;
    return nullptr;
  };
  if (!file->target_.has_filename() || fs::is_directory(file->target_, none))
    return refused("the name is that of a directory");
  if (fs::is_symlink(file->target_, none) && !isOfProcesses(file->target_))
    return refused("it is a link that leads nowhere");
  const bool stream = isStream(target);
  if (stream && kind != UnfinishedKind::Stream) return refused(kIsStream);
  const bool opened = kind == UnfinishedKind::Resumable ? file->openResumable(error)
                      : stream                          ? file->openStream(error)
                                                        : file->openScratch(error);
  return opened ? std::move(file) : nullptr;
}

bool UnfinishedFile::openScratch(std::string& error) {
  try {
    scratch_ =
        std::make_unique<ScratchPath>(target_.parent_path(), target_.filename().string(), ScratchPath::Kind::File);
  } catch (const fs::filesystem_error& e) {
    error = e.code().message();
    return false;
  }
  path_ = scratch_->path().string();
  descriptor_ = scratch_->takeDescriptor();
  return true;
}

bool UnfinishedFile::openStream(std::string& error) {
  descriptor_ = ::open(target_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC);
  return descriptor_ >= 0 || failedWith(errno, error);
}

/// Another process may rename or discard the file between opening and locking it; such a file must not be written to.
bool UnfinishedFile::openResumable(std::string& error) {
  path_ = target_.string() + ".part";
  do {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0) return failedWith(errno, error);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      error = "another program is writing \"" + path_ + "\"";
      return false;
    }
  } while (!isNamed(descriptor_, path_));
  return true;
}

UnfinishedFile::~UnfinishedFile() {
  if (stream_)
    std::fclose(stream_);
  else if (descriptor_ >= 0)
    ::close(descriptor_);
}

std::FILE* UnfinishedFile::stream() {
  if (!stream_) stream_ = ::fdopen(descriptor_, "w");
  return stream_;
}

bool UnfinishedFile::finish(std::string& error) {
  if (stream_ && std::fflush(stream_) != 0) return failedWith(errno, error);
  if (!writtenBack(descriptor_)) return failedWith(errno, error);
  if (path_.empty()) return true;
  if (std::rename(path_.c_str(), target_.c_str()) != 0) return failedWith(errno, error);
  if (scratch_) scratch_->release();
  path_.clear();
  return true;
}

void UnfinishedFile::discard() {
  if (!path_.empty()) ::unlink(path_.c_str());
  if (scratch_) scratch_->release();
  path_.clear();
}

bool writeFile(const std::string& target, const std::string& content, std::string& error) {
  const auto file = UnfinishedFile::create(target, UnfinishedKind::Stream, error);
  if (!file) return false;
  if (std::fwrite(content.data(), 1, content.size(), file->stream()) != content.size()) return failedWith(errno, error);
  return file->finish(error);
}

std::string placeOf(const fs::path& target) {
  std::error_code none;
  const fs::path absolute = fs::absolute(throughLinks(target), none);
  const fs::path place = fs::weakly_canonical(absolute, none);
  return (none ? absolute.lexically_normal() : place).string();
}

bool isAmong(const fs::path& target, const std::vector<std::string>& files) {
  std::error_code none;
  return std::any_of(files.begin(), files.end(),
                     [&](const std::string& file) { return fs::equivalent(file, target, none); });
}

bool moveFinished(const fs::path& from, const fs::path& target, std::string& error) {
  if (isStream(target)) {
    error = kIsStream;
    return false;
  }
  const int file = ::open(from.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return failedWith(errno, error);
  const bool written = writtenBack(file) && std::rename(from.c_str(), throughLinks(target).c_str()) == 0;
  if (!written) failedWith(errno, error);
  ::close(file);
  return written;
}

}  // namespace tomales
