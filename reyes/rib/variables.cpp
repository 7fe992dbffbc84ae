#include "reyes/rib/variables.h"

#include <fmt/format.h>

#include "reyes/attribute_table.h"

namespace tomales::rib {
namespace {

using Found = std::optional<std::string>;

/// Returns the first of its strings, or all of its numbers.
std::string text(const Param& p) {
  if (p.type == ValueType::String) return wordOf(&p);
  return p.ints.empty() ? fmt::format("{}", fmt::join(p.floats, " ")) : fmt::format("{}", fmt::join(p.ints, " "));
}

Found text(const UserParams& all, const std::string& key) {
  const Param* p = findParam(all, key);
  return p ? Found(text(*p)) : std::nullopt;
}

Found option(const Options& o, const std::string& key) {
  if (key == "Frame") return fmt::format("{}", o.frame);
  return text(o.user, key);
}

Found attribute(const Attributes& a, const std::string& key) {
  const NamedAttribute* row = findNamedAttribute(key);
  return row && row->get ? text(row->get(a)) : text(a.user, key);
}

}  // namespace

Found findVariable(const Options& options, const Attributes& attributes, const std::string& name) {
  constexpr std::string_view kOption = "Option:", kAttribute = "Attribute:";
  if (name.starts_with(kOption)) return option(options, name.substr(kOption.size()));
  if (name.starts_with(kAttribute)) return attribute(attributes, name.substr(kAttribute.size()));
  if (auto v = text(attributes.user, "user:" + name)) return v;
  if (auto v = text(options.user, "user:" + name)) return v;
  if (auto v = attribute(attributes, name)) return v;
  return option(options, name);
}

}  // namespace tomales::rib
