# Writes the commit of the sources to OUTPUT, unless it is there already. `git archive` replaces the pattern in
# `set(commit ...)` by the commit (.gitattributes).
cmake_minimum_required(VERSION 3.25)
set(commit "$Format:%H$")
if(commit MATCHES "Format")
  execute_process(COMMAND git rev-parse HEAD WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit RESULT_VARIABLE problem
                  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  execute_process(COMMAND git status --porcelain --untracked-files=no WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE changes ERROR_QUIET)
  if(problem)
    set(commit "unknown")
  elseif(changes)
    string(APPEND commit " with changes")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "extern const char* const tomales_commit;\nconst char* const tomales_commit = \"@commit@\";\n" @ONLY)
