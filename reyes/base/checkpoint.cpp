#include "reyes/base/checkpoint.h"

#include <system_error>

namespace tomales {
namespace {

constexpr RecordFileKind kCheckpointFile{"TomalKPT", 1};

void reportUnkept(Log& log, const std::string& why) {
  log.report(Severity::Note, "resume", {}, "what is gathered and shaded cannot be kept for --resume: " + why);
}

}  // namespace

std::unique_ptr<Checkpoint> Checkpoint::create(const std::string& path, const std::string& identity, Log& log) {
  std::string error;
  auto records = RecordWriter::create(path, kCheckpointFile, Unfinished::Resumed, error);
  if (!records) {
    reportUnkept(log, error);
    return nullptr;
  }
  std::unique_ptr<Checkpoint> checkpoint(new Checkpoint(path, std::move(records), log));
  std::string before;
  if (checkpoint->take(KeptKind::Identity, 0, before) && before == identity) return checkpoint;
  if (!checkpoint->records_->restart()) {
    reportUnkept(log, checkpoint->records_->error());
    return nullptr;
  }
  checkpoint->keep(KeptKind::Identity, 0, identity);
  return checkpoint;
}

void Checkpoint::write(RecordName name, const Bytes& bytes) {
  if (!records_->write(name, bytes)) reportUnkept(log_, records_->error());
}

std::filesystem::path Checkpoint::folder() {
  std::filesystem::create_directories(folder_);
  return folder_;
}

void Checkpoint::forget() {
  records_->discard();
  std::error_code failed;  // a folder that cannot be removed does no harm
  std::filesystem::remove_all(folder_, failed);
}

}  // namespace tomales
