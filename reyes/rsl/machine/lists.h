// The optional list of an instruction, in the form of the tables of reyes/shader/lists.h.
#pragma once
#include "reyes/rsl/machine/call.h"
#include "reyes/shader/lists.h"

namespace tomales::compiler {

/// Returns the value of an entry of a list, with arrays if the service fills it in.
rsl::Setting settingOf(Call& call, const Setting& entry);
/// Reports what is wrong with an entry; `taken` is what set() returned for it.
void tell(Call& call, const std::string& name, const rsl::Setting& value, const rsl::Entry& taken);

/// Returns the options, changed by the list. An entry for which others(name, entry, value) returns true is no option.
template <class Options, class Others>
Options listed(Call& call, Options options, const Others& others) {
  using rsl::set;
  for (const Setting& entry : call.of.settings) {
    const std::string& name = call.run.text(entry.name);
    const rsl::Setting value = settingOf(call, entry);
    rsl::Entry taken = set(options, name, value);
    if (!taken.known) taken.known = others(name, entry, value);
    tell(call, name, value, taken);
  }
  return options;
}
template <class Options>
Options listed(Call& call, Options options) {
  return listed(call, std::move(options), [](const auto&...) { return false; });
}

}  // namespace tomales::compiler
