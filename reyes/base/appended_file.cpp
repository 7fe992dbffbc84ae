#include "reyes/base/appended_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tomales {

std::unique_ptr<AppendedFile> AppendedFile::open(const std::string& path, std::string& error) {
  const int opened = ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (opened < 0) error = std::strerror(errno);
  return std::unique_ptr<AppendedFile>(opened < 0 ? nullptr : new AppendedFile(opened));
}

AppendedFile::~AppendedFile() { ::close(descriptor_); }

// One call of write() with O_APPEND is atomic (POSIX).
bool AppendedFile::write(const std::string& lines, std::string& error) const {
  errno = ENOSPC;  // the reason if only a part was written
  if (::write(descriptor_, lines.data(), lines.size()) == static_cast<ssize_t>(lines.size())) return true;
  error = std::strerror(errno);
  return false;
}

}  // namespace tomales
