// Procedural, Procedural2 and System. Procedurals are expanded where they stand, not when their bound is met.
#include <fmt/format.h>

#include "reyes/rib/program.h"
#include "reyes/rib/reader.h"

namespace tomales::rib {
namespace {

constexpr size_t kProgramCost = 1000;
constexpr double kSystemPatience_s = 3600;

std::string text(const ParamList& params, const char* name) {
  const Param* p = findParam(params, name);
  return p && !p->strings.empty() ? p->strings[0] : "";
}

// Infinite is "now"; what is no box at all is worth a word.
bool isBox(const std::vector<float>& b) {
  return b.size() == 6 && b[0] <= b[1] && b[2] <= b[3] && b[4] <= b[5];
}

}  // namespace

void Reader::procedural(const Request& r) {
  const std::string& kind = r.args[0].strings[0];
  const std::vector<std::string>& data = r.args[1].strings;
  if (kind == "DelayedReadArchive" && !data.empty())
    delayedArchive(r, data[0], r.args[2].numbers);
  else if (kind == "RunProgram" && !data.empty())
    runProgram(r);
  else
    report(Severity::Missing, "rib-unsupported", r,
           fmt::format("\"{}\" with {} arguments is not supported; nothing is drawn in its place", kind,
                       data.size()));
}

void Reader::procedural2(const Request& r) {
  const std::string& kind = r.args[0].strings[0];
  const std::string file = text(r.params, "filename");
  const Param* bound = findParam(r.params, "bound");
  if (kind == "DelayedReadArchive2" && !file.empty())
    delayedArchive(r, file, bound ? bound->floats : std::vector<float>());
  else
    report(Severity::Missing, "rib-unsupported", r,
           fmt::format("\"{}\" {}; nothing is drawn in its place", kind,
                       kind == "DelayedReadArchive2" ? "names no file" : "is not supported"));
}

void Reader::delayedArchive(const Request& r, const std::string& name, const std::vector<float>& bound) {
  if (!isBox(bound)) report(Severity::Warning, "rib-bound", r, "its bound is no box; it is read without");
  perform("AttributeBegin", r.where);
  readArchiveNamed(r, name);
  perform("AttributeEnd", r.where);
}

void Reader::perform(const char* blockName, const SourceLoc& where) {
  builder_.request({blockName, {}, {}, where});
}

bool Reader::allowed(const Request& r, const std::string& command) const {
  if (!settings_.allowSystem)
    report(Severity::Missing, "rib-system", r,
           fmt::format("\"{}\" is not run, because programs are not allowed (--allow-system)",
                       command.substr(0, 200)));
  return settings_.allowSystem;
}

// RISpec 3.2 section 5.10: one line of detail and data in, RIB out, closed by 0377. Each request has a
// process of its own, whose input ends after that line.
void Reader::runProgram(const Request& r) {
  const std::vector<std::string>& call = r.args[1].strings;
  if (!allowed(r, call[0])) return;
  const std::string name = "output of " + call[0];
  if (!mayEnter(r, fmt::format("{}: program {}", open_.size(), call[0]), kProgramCost)) return;
  const float detail = builder_.rasterArea(r.args[2].numbers);
  Program program(call[0], fmt::format("{:g} {}\n", detail, call.size() > 1 ? call[1] : ""),
                  settings_.programPatience_s);
  const auto stream = ByteStream::fromProgram([&](char* b, size_t n) { return program.read(b, n); });
  perform("AttributeBegin", r.where);
  const size_t count =
      read(*stream, name, fmt::format("{}: program", open_.size()), std::string(open_.back().folder));
  perform("AttributeEnd", r.where);
  if (stream->closed()) return;
  const std::string trouble = program.finish();
  if (!trouble.empty() || count == 0)
    report(Severity::Missing, "rib-program", r,
           fmt::format("\"{}\" {}; what it wrote before is used", call[0].substr(0, 200),
                       trouble.empty() ? "wrote no request" : trouble));
}

void Reader::system(const Request& r) {
  const std::string& command = r.args[0].strings[0];
  if (!allowed(r, command)) return;
  Program program(command, "", kSystemPatience_s);
  char buffer[4096];
  for (size_t n = program.read(buffer, sizeof buffer); n > 0; n = program.read(buffer, sizeof buffer))
    std::fwrite(buffer, 1, n, stderr);
  if (const std::string trouble = program.finish(); !trouble.empty())
    report(Severity::Missing, "rib-system", r, fmt::format("\"{}\" {}", command.substr(0, 200), trouble));
}

}  // namespace tomales::rib
