// Procedural, Procedural2 and System. A procedural is read when its bound is needed, by a Reader of its own that has
// the state of the procedural's place.
#include <fmt/format.h>

#include "reyes/rib/program.h"
#include "reyes/rib/reader.h"

namespace tomales::rib {
namespace {

// Cost of a procedural within another, or within an archive: it keeps the state around it in memory until it is opened.
constexpr size_t kProceduralCost = 20;
constexpr size_t kProgramCost = 1000;
constexpr size_t kAnswerCost = 10;  // cost of a request of a program: what it draws takes a kilobyte
constexpr double kSystemPatience_s = 3600;
constexpr size_t kLongestAnswer = size_t{1} << 30;  // bytes

// An infinite box is a box too, and means "read it now".
bool isBox(const std::vector<float>& b) { return b.size() == 6 && b[0] <= b[1] && b[2] <= b[3] && b[4] <= b[5]; }

}  // namespace

Reader::Reader(const ProceduralContext& around, const SceneBuilder::LocalState& place,
               std::shared_ptr<std::atomic<size_t>> budget)
    : settings_(around.settings),
      log_(around.log),
      dictionary_(around.dictionary),
      builder_(around.settings, around.log, around.builder, place),
      inlineArchives_(around.archives),
      budget_(std::move(budget)),
      inProcedural_(true),
      programs_(around.programs),
      plugins_(around.plugins),
      mark_(around.mark) {
  for (const std::string& key : around.keys) enter(key, around.folder);
}

std::shared_ptr<const Reader::ProceduralContext> Reader::proceduralContext() {
  if (proceduralContext_) return proceduralContext_;
  std::vector<std::string> keys;
  for (const Level& level : open_) keys.push_back(level.key);
  proceduralContext_ = std::make_shared<const ProceduralContext>(
      ProceduralContext{settings_, log_, dictionary_, inlineArchives_, mark_, std::move(keys), open_.back().folder,
                        builder_.streamState(), programs_, plugins_});
  return proceduralContext_;
}

void Reader::procedural(const Request& r) {
  const std::string& kind = r.args[0].strings[0];
  const std::vector<std::string>& data = r.args[1].strings;
  if (!canRead(r, kind, data.empty() ? "" : data[0])) return;
  const auto read = kind == "RunProgram"    ? &Reader::runProgram
                    : kind == "DynamicLoad" ? &Reader::dynamicLoad
                                            : &Reader::delayedArchive;
  later(r, [r, read](Reader& reader) { (reader.*read)(r); });
}

// The arguments are the subdivide function and the bound function, then parameters, which are the data of the former.
void Reader::procedural2(const Request& r) {
  const std::string &kind = r.args[0].strings[0], &bounding = r.args[1].strings[0];
  const bool program = kind == "RunProgram2", plugin = kind == "DynamicLoad2";
  const Param* bound = findParam(r.params, "bound");
  if (!bound) bound = findParam(r.params, "__bound");  // PRMan's spelling
  Request plain{r.name, {}, {}, r.where};
  const auto strings = [](std::vector<std::string> s) { return RibArg{RibArg::Kind::Strings, {}, std::move(s)}; };
  plain.args.push_back({RibArg::Kind::String, {}, {kind.ends_with('2') ? kind.substr(0, kind.size() - 1) : kind}});
  std::vector<std::string> data{wordOf(r.params, program ? "programname" : plugin ? "dsoname" : "filename")};
  if (program || plugin) data.push_back(wordOf(r.params, "data"));
  plain.args.push_back(strings(std::move(data)));
  plain.args.push_back({RibArg::Kind::Numbers, bound ? bound->floats : std::vector<float>(), {}});
  if (bounding != "SimpleBound")
    report(Severity::Warning, "rib-bound", r,
           fmt::format("\"{}\" is not supported: it is read without a bound", bounding));
  procedural(plain);
}

bool Reader::canRead(const Request& r, const std::string& kind, const std::string& what) const {
  const bool program = kind == "RunProgram", plugin = kind == "DynamicLoad";
  if (!program && !plugin && kind != "DelayedReadArchive")
    report(Severity::Missing, "rib-unsupported", r,
           fmt::format("\"{}\" is not supported; nothing is drawn in its place", kind));
  else if (what.empty())
    report(Severity::Missing, "rib-unsupported", r,
           fmt::format("\"{}\" names no {}; nothing is drawn in its place", kind,
                       program  ? "program"
                       : plugin ? "plugin"
                                : "file"));
  else
    return program ? what == settings_.trust.program || allowed(r, what) : !plugin || !pluginFile(r, what).empty();
  return false;
}

void Reader::later(const Request& r, const std::function<void(Reader&)>& readNow) {
  const std::vector<float>& bound = r.args[2].numbers;
  if (!isBox(bound)) report(Severity::Warning, "rib-bound", r, "its bound is no box; it is read without");
  const bool isFinite = std::all_of(bound.begin(), bound.end(), [](float f) { return std::isfinite(f); });
  if (!isBox(bound) || !isFinite || !builder_.takesProcedurals()) return readNow(*this);
  auto budget = inProcedural_ || open_.size() > 1 ? budget_ : newBudget();
  if (budget == budget_ && !spend(kProceduralCost))
    return report(Severity::Missing, "rib-archive-recursion", r,
                  "procedurals within procedurals or archives stand for more than the limit; ignored");
  builder_.addProcedural(
      bound,
      [readNow, around = proceduralContext(), place = builder_.place(), budget] {
        Reader reader(*around, place, budget);
        readNow(reader);
        return reader.builder_.takeExpansion();
      },
      r.where);
}

void Reader::delayedArchive(const Request& r) {
  performBlock("AttributeBegin", r.where);
  readArchiveNamed(r, r.args[1].strings[0]);
  performBlock("AttributeEnd", r.where);
}

void Reader::performBlock(const char* name, const SourceLoc& where) { builder_.request({name, {}, {}, where}); }

bool Reader::allowed(const Request& r, const std::string& command) const {
  if (settings_.trust.programs) return true;
  tellOfFile(r, "program", command, "");
  report(Severity::Missing, "rib-system", r,
         fmt::format("\"{}\" is not run, because programs of a scene can do whatever you can; --allow-system allows "
                     "them",
                     command.substr(0, 200)));
  return false;
}

// RISpec 3.2 section 5.10: one line of detail and data goes in, RIB comes out, closed by 0377; then the program waits
// for the next line.
void Reader::runProgram(const Request& r) {
  const std::vector<std::string>& call = r.args[1].strings;
  tellOfFile(r, "program", call[0], call[0]);
  const std::string name = "output of " + call[0];
  if (!mayEnter(r, fmt::format("{}: program {}", open_.size(), call[0]), kProgramCost)) return;
  const float detail = isBox(r.args[2].numbers) ? builder_.rasterArea(r.args[2].numbers) : kInfinity;
  auto program = programs_->take(call[0]);
  program->ask(fmt::format("{:g} {}\n", detail, call.size() > 1 ? call[1] : ""), settings_.programPatience_s);
  size_t bytes = 0;
  const auto stream = ByteStream::fromProgram([&](char* b, size_t n) {
    const size_t got = bytes < kLongestAnswer ? program->read(b, n) : 0;
    bytes += got;
    return got;
  });
  performBlock("AttributeBegin", r.where);
  const size_t count =
      read(*stream, name, fmt::format("{}: program", open_.size()), std::string(open_.back().folder), kAnswerCost);
  performBlock("AttributeEnd", r.where);
  if (bytes >= kLongestAnswer || *budget_ < kAnswerCost)
    return report(
        Severity::Missing, "rib-program", r,
        fmt::format("\"{}\" does not end its answer; it is killed, and the rest is not read", call[0].substr(0, 200)));
  if (stream->closed()) return programs_->giveBack(call[0], std::move(program));
  const std::string trouble = program->finish();
  if (!trouble.empty() || count == 0)
    report(Severity::Missing, "rib-program", r,
           fmt::format("\"{}\" {}; what it wrote before is used", call[0].substr(0, 200),
                       trouble.empty() ? "wrote no request" : trouble));
}

void Reader::system(const Request& r) {
  const std::string& command = r.args[0].strings[0];
  if (!allowed(r, command)) return;
  Program program(command);
  program.ask("", kSystemPatience_s);
  program.closeInput();
  char buffer[4096];
  for (size_t n = program.read(buffer, sizeof buffer); n > 0; n = program.read(buffer, sizeof buffer))
    std::fwrite(buffer, 1, n, stderr);
  if (const std::string trouble = program.finish(); !trouble.empty())
    report(Severity::Missing, "rib-system", r, fmt::format("\"{}\" {}", command.substr(0, 200), trouble));
}

}  // namespace tomales::rib
