// The edits of a shot that lie in a folder as files of `tomales shade --edit`, by name. Threads: any.
#pragma once
#include <mutex>
#include <set>
#include <string>

#include "reyes/app/relight/edit_state.h"

namespace tomales {

class SavedEdits {
 public:
  explicit SavedEdits(std::string folder) : folder_(std::move(folder)) {}

  /// Returns the names of all edits of this shot. Scenes and other RIB files in the folder are left out.
  std::set<std::string> names(const Editable& editable) const;

  /// The files that were written.
  struct Written {
    std::string edit;
    std::string irradiance;  ///< Empty: nothing was gathered.
  };
  /// Writes the state as NAME.rib, and a copy of the records in the file `gathered`, if there is one, as NAME.icf. It
  /// replaces an edit of this shot, and records that it has written itself, but no other file. Throws BadRequest if
  /// another file is in the way, before anything is written, or if a file cannot be written.
  Written save(const std::string& name, const EditState& state, const std::string& gathered, const Editable& editable);

  /// Throws BadRequest if there is no such edit, or if it is not one of this shot.
  EditState load(const std::string& name, const Editable& editable) const;

 private:
  const std::string folder_;
  std::mutex mutex_;                  ///< One writes at a time.
  std::set<std::string> ownRecords_;  ///< Files of records that save() has written.
};

}  // namespace tomales
