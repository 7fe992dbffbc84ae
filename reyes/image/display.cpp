#include <filesystem>

#include "reyes/image/cryptomatte.h"
#include "reyes/image/deep_rows.h"
#include "reyes/image/display_format.h"
#include "reyes/image/encoding.h"
#include "reyes/image/formats.h"
#include "reyes/image/view.h"
#include "reyes/image_files.h"
#include "reyes/pictures.h"

namespace tomales {

struct DisplayFile::Impl {
  Impl(const Image& whole, const FrameOutput& output, size_t index, const Options& o, Log& l, const View& view,
       const MatteNames& names, const PluginTrust& trust)
      : display(o.displays[index]), options(o), log(l), path(display.name), selection(output.displays[index]) {
    chooseFormat(view, trust);
    shape = whole;
    shape.channels.clear();
    shape.pixels.clear();
    if (writesDeep(display)) openDeep();
    describeView(view);
    selectFloats(whole, output);
    const bool holdsNumbers = !format.kind->quantises || prepareIntegers();
    if (addMattes(output, names) && holdsNumbers) file = std::make_unique<PictureFile>(path, shape, format);
    if (file && !file->error().empty()) report();
    if (file && format.driver) warnOfUnreadParams(display, file->unread(), log);
  }

  /// Finds the format of the file, or the display driver that takes its place.
  void chooseFormat(const View& view, const PluginTrust& trust) {
    const std::string driver = driverOf(display, options, trust);
    if (driver.empty()) {
      warnOfRefusedDriver(display, options, trust, log);
      warnAboutParams(display, log);
      path = fileOf(display);
      format = formatOf(display, log);
    } else {
      format = {&driverFormat(), SampleType::Float};
      format.driver = {driver, display, view};
    }
    format.pixelAspect = options.pixelAspect;
  }

  /// Adds what readers of the file may want to know of the camera and the filter.
  void describeView(const View& view) {
    for (Metadata& m : cameraOf(view)) format.metadata.push_back(std::move(m));
    if (writesDeep(display) || writesShadowMap(display))
      format.metadata.push_back(matrixEntry("worldtoscreen", view.screenFromWorld));
    if (!writesDeep(display)) return;
    const PixelFilter filter = positiveFilter(options);
    format.metadata.push_back(
        {kSampleRegion,
         "",
         {2.0f * static_cast<float>(filter.reachX()) + 1, 2.0f * static_cast<float>(filter.reachY()) + 1}});
  }

  /// Names the channels of the file, and finds their floats in the frame's picture.
  void selectFloats(const Image& whole, const FrameOutput& output) {
    const std::vector<std::string> floats = output.names();
    for (const SelectedFloat& f : selection) {
      const Channel& channel = output.channels[static_cast<size_t>(f.channel)];
      from.push_back(whole.channelIndex(floats[static_cast<size_t>(channel.first + f.component)]));
      shape.channels.push_back(f.name);
      depth.push_back(channel.kind == ChannelKind::Depth);
      // Depth, position and ids lose their meaning in half floats.
      if (depth.back() || channel.type == ValueType::Point || isMatte(channel.kind)) format.precise.push_back(f.name);
    }
  }

  /// Adds the names of each Cryptomatte that the Display shows. Returns false if the format has no room for them.
  bool addMattes(const FrameOutput& output, const MatteNames& names) {
    bool good = true;
    for (const Channel& c : output.channels)
      if (isMatte(c.kind) && std::any_of(selection.begin(), selection.end(), [&](const SelectedFloat& f) {
            return &output.channels[static_cast<size_t>(f.channel)] == &c;
          }))
        good = addMatte(c.kind, names) && good;
    return good;
  }

  bool addMatte(ChannelKind kind, const MatteNames& names) {
    if (!format.kind->carriesNames) {
      log.report(Severity::Output, "display-matte", display.where,
                 "\"" + path + "\" could not be written: Cryptomatte needs " + pictureFormats().front()->title);
      return false;
    }
    for (Metadata& m : cryptoMetadata(matteLayer(kind), kind == ChannelKind::Objects ? names.objects : names.materials))
      format.metadata.push_back(std::move(m));
    return true;
  }

  void openDeep() {
    format.deep = true;
    format.tile = 0;
    format.multipart = false;
    format.compression.clear();
    format.precise = {"Z", "ZBack"};
    merge.opacityOnly = writesMap(display);
    if (const Param* p = findParam(display.params, "mergedepth")) merge.depth = std::max(0.0f, p->number(0));
    if (const Param* p = findParam(display.params, "mergeopacity")) merge.opacity = std::max(0.0f, p->number(0));
    shape.channels = merge.opacityOnly ? std::vector<std::string>{"AR", "AG", "AB", "Z", "ZBack"}
                                       : std::vector<std::string>{"R", "G", "B", "A", "Z", "ZBack"};
    if (PixelFilter(options.filter, 2, 2).hasNegativeLobes())
      log.report(Severity::Warning, "display-deep-filter", display.where,
                 "Display \"" + display.name + "\": deep pixels cannot have a filter with negative lobes, such as " +
                     options.filter + "; a box of one pixel is used");
  }

  /// Fits the type of an integer format to Quantize. Returns false if the format cannot hold it.
  bool prepareIntegers() {
    const bool anyDepth = std::find(depth.begin(), depth.end(), true) != depth.end();
    const bool mixed = anyDepth && std::find(depth.begin(), depth.end(), false) != depth.end();
    bool floats = mixed, wide = false;
    for (size_t i = 0; i < selection.size(); ++i) {
      Quantize q = selection[i].encoding.quantize.value_or(depth[i] ? options.depthQuantize : options.rgbaQuantize);
      floats = floats || q.one <= 0;
      wide = wide || q.one > 255 || q.max > 255;
      quantizers.push_back(q);
    }
    if (floats && format.kind->floats) {
      quantizers.clear();
      format.type = SampleType::Float;
      return true;
    }
    if (floats && anyDepth) {
      log.report(
          Severity::Output, "display-depth", display.where,
          "\"" + path + "\" could not be written: " + format.kind->title + " holds no depth; use " + floatFormats());
      return false;
    }
    if (floats) {
      log.report(Severity::Warning, "display-quantize", display.where,
                 "Display \"" + display.name + "\": " + format.kind->title +
                     " holds no floating point numbers; quantised to 8 bits");
      quantizers.assign(selection.size(), Quantize{});
      wide = false;
    }
    screen = displayText(display, "transfer") == "srgb" && !anyDepth;
    format.unassociatedAlpha = screen || (format.kind->dividesColor && !anyDepth);
    format.type = wide ? SampleType::UInt16 : SampleType::UInt8;
    return true;
  }

  Image picked(const Image& rows) const {
    Image out = shape;
    out.originY = rows.originY;
    out.height = rows.height;
    const size_t step = rows.channels.size(), pixels = rows.pixels.size() / step;
    out.pixels.resize(pixels * from.size());
    for (size_t c = 0; c < from.size(); ++c) {
      if (from[c] < 0) continue;  // a channel that does not exist is 0
      float* to = out.pixels.data() + c;
      const float* value = rows.pixels.data() + from[c];
      for (size_t i = 0; i < pixels; ++i) to[i * from.size()] = value[i * step];
      const auto& exposure = selection[c].encoding.exposure;
      for (size_t i = 0; exposure && !depth[c] && i < pixels; ++i)
        to[i * from.size()] = exposed(to[i * from.size()], (*exposure)[0], (*exposure)[1]);
    }
    return out;
  }

  bool write(const Image& rows) {
    if (!file) return false;
    Image out = picked(rows);
    if (format.unassociatedAlpha) divideByAlpha(out);
    if (screen) encodeForScreen(out);
    if (!quantizers.empty()) quantise(out, quantizers, format.type == SampleType::UInt16 ? 65535.0f : 255.0f);
    return file->write(out) || report();
  }

  bool write(const DeepRows& rows) { return file && (file->write(rows) || report()); }

  bool close(float finished) {
    if (!file || !(file->close(finished) || report())) return false;
    if (finished < 1 && !format.driver) {
      log.report(Severity::Warning, "output-partial", display.where,
                 "\"" + path + "\" would not be whole: what is finished is in \"" + partialName(path) + "\" beside it");
      path = std::filesystem::path(path).replace_filename(partialName(path)).string();
    }
    return true;
  }

  bool report() {
    log.report(Severity::Output, "image-write", display.where,
               "\"" + path + "\" could not be written: " + file->error());
    file.reset();
    return false;
  }

  const DisplayCall display;
  const Options& options;
  Log& log;
  std::string path;
  const Selection selection;
  FileFormat format;
  Image shape;
  std::vector<int> from;  ///< Index of every float in a pixel of the frame's picture; -1 if it does not exist.
  std::vector<bool> depth;
  std::vector<Quantize> quantizers;  ///< If empty, floats are written.
  bool screen = false;
  DeepMerge merge;
  std::unique_ptr<PictureFile> file;  ///< Null if it has failed, which has been reported.
};

DisplayFile::DisplayFile(const Image& shape, const FrameOutput& output, size_t index, const Options& options, Log& log,
                         const View& view, const MatteNames& names, const PluginTrust& trust)
    : impl_(new Impl(shape, output, index, options, log, view, names, trust)) {}
DisplayFile::~DisplayFile() = default;
bool DisplayFile::hasBegun() const { return impl_->file != nullptr; }
bool DisplayFile::write(const Image& rows) { return impl_->write(rows); }
bool DisplayFile::write(const DeepRows& rows) { return impl_->write(rows); }
std::optional<DeepMerge> DisplayFile::deep() const {
  return writesDeep(impl_->display) ? std::optional(impl_->merge) : std::nullopt;
}
bool DisplayFile::close(float finished) { return impl_->close(finished); }
const std::string& DisplayFile::written() const { return impl_->path; }

bool displaysCanBegin(const Options& options, const PluginTrust& trust, Log& log) {
  const PixelRect crop = Camera(options).crop();
  const FrameOutput output = outputOf(options);
  const Image shape{crop.width(), crop.height(), output.names(),      {},
                    crop.x0,      crop.y0,       options.xResolution, options.yResolution};
  bool all = true;
  for (size_t i = 0; i < options.displays.size(); ++i) {
    const DisplayCall& d = options.displays[i];
    if (d.type == "null" || !driverOf(d, options, trust).empty()) continue;
    // The frame begins each Display once more, and reports then what is worth a warning.
    Log trial(Log::Verbosity::Silent);
    if (DisplayFile(shape, output, i, options, trial, {}, {}, trust).hasBegun()) continue;
    all = false;
    for (const LogEntry& e : trial.entries()) log.report(e.severity, e.code, e.where, e.message);
  }
  return all;
}

bool writeDisplay(const Image& image, const DisplayCall& display, const Options& options, Log& log) {
  Options one = options;
  one.displays = {display};
  DisplayFile file(image, outputOf(one, &log), 0, one, log);
  return file.write(image) && file.close();
}

bool makeShadow(const std::string& picture, const std::string& map, const SourceLoc& where, Log& log) {
  std::string error;
  const Making made = copyShadowMap(picture, map, error);
  if (made == Making::Done) return true;
  log.report(severityOf(made), "make-shadow", where,
             "MakeShadow: no map \"" + map + "\" was made of \"" + picture + "\": " + error);
  return false;
}

bool writeImage(const std::string& path, const Image& image, bool srgb, Log& log) {
  const PictureFormat* kind = formatOfExtension(path);
  if (!kind) {
    log.report(Severity::Output, "image-write", {},
               "\"" + path + "\" could not be written: its extension names none of " + pictureExtensions());
    return false;
  }
  FileFormat format{kind, kind->usualType()};
  Image copy = image;
  if (format.type == SampleType::UInt8) {
    format.unassociatedAlpha = srgb || kind->dividesColor;
    if (format.unassociatedAlpha) divideByAlpha(copy);
    if (srgb) encodeForScreen(copy);
    quantise(copy, std::vector<Quantize>(copy.channels.size(), Quantize{255, 0, 255, 0}), 255);
  }
  PictureFile file(path, copy, format);
  if (file.write(copy) && file.close()) return true;
  log.report(Severity::Output, "image-write", {}, "\"" + path + "\" could not be written: " + file.error());
  return false;
}

}  // namespace tomales
