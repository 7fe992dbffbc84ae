#include "reyes/base/kept_work.h"

#include <system_error>

namespace tomales {
namespace {

constexpr RecordFileKind kKeptWork{"TomalKPT", 1};

void reportUnkept(Log& log, const std::string& why) {
  log.report(Severity::Note, "resume", {}, "what is gathered and shaded cannot be kept for --resume: " + why);
}

}  // namespace

std::unique_ptr<KeptWork> KeptWork::create(const std::string& path, const std::string& identity, Log& log) {
  std::string error;
  auto records = RecordWriter::create(path, kKeptWork, Unfinished::Resumed, error);
  if (!records) {
    reportUnkept(log, error);
    return nullptr;
  }
  std::unique_ptr<KeptWork> work(new KeptWork(path, std::move(records), log));
  std::string before;
  if (work->take(KeptKind::Identity, 0, before) && before == identity) return work;
  if (!work->records_->restart()) {
    reportUnkept(log, work->records_->error());
    return nullptr;
  }
  work->keep(KeptKind::Identity, 0, identity);
  return work;
}

void KeptWork::write(RecordName name, const Bytes& bytes) {
  if (!records_->write(name, bytes)) reportUnkept(log_, records_->error());
}

std::filesystem::path KeptWork::folder() {
  std::filesystem::create_directories(folder_);
  return folder_;
}

void KeptWork::forget() {
  records_->discard();
  std::error_code failed;  // a folder that cannot be removed does no harm
  std::filesystem::remove_all(folder_, failed);
}

}  // namespace tomales
