#include "reyes/base/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tomales {
namespace {

/// Returns what kind of file it is if it is not a regular one; empty for a regular file.
std::string strangenessOf(mode_t mode) {
  switch (mode & S_IFMT) {
    case S_IFREG:
      return {};
    case S_IFDIR:
      return "it is a folder";
    case S_IFIFO:
      return "it is a pipe, and a regular file is needed";
    case S_IFSOCK:
      return "it is a socket, and a regular file is needed";
    default:
      return "it is a device, and a regular file is needed";
  }
}

}  // namespace

std::string inputProblem(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) return std::strerror(errno);
  if (std::string strange = strangenessOf(status.st_mode); !strange.empty()) return strange;
  return ::access(path.c_str(), R_OK) == 0 ? std::string() : std::strerror(errno);
}

int openInput(const std::filesystem::path& path, std::string& error) {
  error = inputProblem(path);
  if (!error.empty()) return -1;
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) error = std::strerror(errno);
  return file;
}

}  // namespace tomales
