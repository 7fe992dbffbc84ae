#include "reyes/app/relight/saved_edits.h"

#include <algorithm>
#include <filesystem>

#include "reyes/base/temporary_folder.h"
#include "reyes/base/unfinished_file.h"

namespace tomales {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEdit = ".rib";
constexpr const char* kRecords = ".icf";
constexpr size_t kLongestName = 64;
constexpr uintmax_t kMostEdit_bytes = 1 << 20;

/// Returns the file of an edit. A name has only letters, digits, - and _, so it cannot lead out of the folder.
fs::path fileOfEdit(const std::string& folder, const std::string& name) {
  const auto plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; };
  if (name.empty() || name.size() > kLongestName || !std::ranges::all_of(name, plain))
    throw BadRequest("a name has up to 64 letters, digits, - and _");
  return fs::path(folder) / (name + kEdit);
}

bool isEdit(const fs::path& file, const Editable& editable) {
  std::error_code failed;
  if (file.extension() != kEdit || !fs::is_regular_file(file, failed) || fs::file_size(file, failed) > kMostEdit_bytes)
    return false;
  try {
    stateOfRib({file.string()}, editable);
  } catch (const BadRequest&) {
    return false;
  }
  return true;
}

bool isThere(const fs::path& file) { return fs::exists(fs::symlink_status(file)); }

/// Copies a file in such a way that `to` is at any time either the old file or the whole copy.
bool copyFinished(const fs::path& from, const fs::path& to, std::string& error) {
  try {
    const TemporaryFolder beside(to.parent_path());
    const fs::path copy = beside.path() / to.filename();
    fs::copy_file(from, copy);
    return moveFinished(copy, to, error);
  } catch (const fs::filesystem_error& e) {
    error = e.code().message();
    return false;
  }
}

}  // namespace

std::set<std::string> SavedEdits::names(const Editable& editable) const {
  std::set<std::string> out;
  std::error_code failed;  // then there are none
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_, failed))
    if (isEdit(entry.path(), editable)) out.insert(entry.path().stem().string());
  return out;
}

SavedEdits::Written SavedEdits::save(const std::string& name, const EditState& state, const std::string& gathered,
                                     const Editable& editable) {
  const fs::path file = fileOfEdit(folder_, name), records = fs::path(file).replace_extension(kRecords);
  const std::lock_guard lock(mutex_);
  if (isThere(file) && !isEdit(file, editable))
    throw BadRequest(file.filename().string() + " exists, and is no edit of this shot: take another name");
  if (!gathered.empty() && isThere(records) && !ownRecords_.contains(records.string()))
    throw BadRequest(records.filename().string() + " exists: take another name");
  std::string error;
  if (!writeFile(file.string(), ribOf(state, editable), error))
    throw BadRequest(file.string() + " could not be written: " + error);
  if (gathered.empty()) return {file.string(), ""};
  if (!copyFinished(gathered, records, error)) throw BadRequest(records.string() + " could not be written: " + error);
  ownRecords_.insert(records.string());
  return {file.string(), records.string()};
}

EditState SavedEdits::load(const std::string& name, const Editable& editable) const {
  const fs::path file = fileOfEdit(folder_, name);
  if (!fs::is_regular_file(file)) throw BadRequest("there is no such edit");
  return stateOfRib({file.string()}, editable);
}

}  // namespace tomales
