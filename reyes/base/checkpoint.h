// Keeps the expensive work that a run has finished in a file beside the picture, so that a later run can take it over
// (--resume). Results are kept by name, as soon as they are there, and survive whatever ends the program. Threads:
// take() and keep() may be called concurrently.
#pragma once
#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

#include "reyes/base/log.h"
#include "reyes/base/pack.h"

namespace tomales {

/// The kinds of results. A result's name is its kind and an index among those of its kind.
enum class KeptKind : uint32_t {
  Identity,
  GatherSites,
  GatherRecords,
  BounceRecords,
  RadiosityTexels,
  ShadedTile,
  CountedPhotons,
};

class Checkpoint {
 public:
  /// `identity` stands for everything that the results depend on: results of another identity are dropped. The file is
  /// called PATH.part. Returns null if it cannot be written, which is reported.
  static std::unique_ptr<Checkpoint> create(const std::string& path, const std::string& identity, Log& log);

  bool has(KeptKind kind, size_t index) const { return records_->has(nameOf(kind, index)); }
  /// Sets `out` to a result of an earlier run or of this one. Returns false if there is none.
  template <class T>
  bool take(KeptKind kind, size_t index, T& out) const {
    const auto bytes = records_->read(nameOf(kind, index));
    Unpacker unpacker{bytes ? BytesView(*bytes) : BytesView()};
    const auto schema = unpacker.get<uint64_t>();
    if (unpacker.damaged || schema != schemaOf<T>()) return false;
    T result = unpacker.get<T>();
    if (unpacker.damaged || !unpacker.bytes.empty()) return false;
    out = std::move(result);
    return true;
  }
  template <class T>
  void keep(KeptKind kind, size_t index, const T& result) {
    Packer packer;
    packer.put(schemaOf<T>(), result);  // builds whose structures differ do not read each other's results
    write(nameOf(kind, index), packer.bytes);
  }
  /// Returns PATH.maps, a folder for maps that a method of light makes in files. The first call makes it.
  std::filesystem::path folder();
  /// Removes the file and the folder of maps: the picture is written, so nothing is left to resume.
  void forget();

 private:
  Checkpoint(const std::string& path, std::unique_ptr<RecordWriter> records, Log& log)
      : folder_(path + ".maps"), records_(std::move(records)), log_(log) {}
  static RecordName nameOf(KeptKind kind, size_t index) {
    return {static_cast<uint32_t>(kind), static_cast<uint32_t>(index)};
  }
  void write(RecordName name, const Bytes& bytes);

  const std::filesystem::path folder_;
  const std::unique_ptr<RecordWriter> records_;
  Log& log_;
};

}  // namespace tomales
