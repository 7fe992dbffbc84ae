#include "reyes/app/catrib.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "reyes/rib.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

/// Standard output, a pipe or a device, or else a temporary name that becomes the file at the end: the output may be
/// one of the inputs.
class Output {
 public:
  explicit Output(const std::string& path) : path_(path) {
    std::error_code none;
    const fs::file_status there = fs::status(path, none);
    if (!path.empty() && (!fs::exists(there) || fs::is_regular_file(there)))
      temporary_ = fmt::format("{}.{}.part", path, ::getpid());
    file_ = path.empty() ? stdout : std::fopen((temporary_.empty() ? path : temporary_).c_str(), "wb");
    if (!file_) fail();
  }
  ~Output() {
    if (file_ && file_ != stdout) std::fclose(file_);
    std::error_code none;
    if (!temporary_.empty()) fs::remove(temporary_, none);
  }
  Output(const Output&) = delete;

  void write(std::string_view text) {
    if (file_ && std::fwrite(text.data(), 1, text.size(), file_) != text.size()) fail();
  }
  /// `isWhole`: else a file of that name is left as it was.
  void finish(bool isWhole) {
    if (file_ && std::fflush(file_) != 0) fail();
    std::error_code problem;
    if (!error_.empty() || temporary_.empty() || (!isWhole && fs::exists(path_, problem))) return;
    fs::rename(temporary_, path_, problem);
    if (problem) error_ = problem.message();
  }
  const std::string& error() const { return error_; }

 private:
  void fail() {
    if (error_.empty()) error_ = std::strerror(errno);
  }

  const std::string path_;
  std::string temporary_, error_;
  std::FILE* file_ = nullptr;
};

}  // namespace

int catribCommand(const CatribSettings& settings) {
  Log log;
  Output out(settings.output);
  if (out.error().empty())
    out.finish(parseRib(
        settings.files,
        *makeRibWriter({settings.binary, settings.gzip, [&](std::string_view text) { out.write(text); }}), log));
  if (!out.error().empty())
    log.report(Severity::Output, "output-write",
               {std::make_shared<std::string>(settings.output.empty() ? "standard output" : settings.output), 0},
               "cannot be written: " + out.error());
  return exitCodeOf(log);
}

}  // namespace tomales
