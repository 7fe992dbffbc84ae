# Makes one test of CTest for each suite of a GoogleTest program. gtest_discover_tests makes one for each test. To start
# this number of processes would take a tenth of the time of all tests.

# The tests are called PREFIX.SUITE. They run with one variable of the environment, NAME=VALUE.
function(tomales_suites target prefix label environment)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/${target}_suites.cmake)
  add_custom_command(TARGET ${target} POST_BUILD VERBATIM
                     COMMAND ${CMAKE_COMMAND} -D PROGRAM=$<TARGET_FILE:${target}> -D PREFIX=${prefix} -D LABEL=${label}
                             -D ENVIRONMENT=${environment} -D FILE=${file} -P ${CMAKE_CURRENT_SOURCE_DIR}/suites.cmake)
  if(NOT EXISTS ${file})
    file(WRITE ${file} "add_test(${target}_is_not_built ${target})\n")
  endif()
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${file})
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "(^|\n)[A-Za-z0-9_/]+\\." suites "${listed}")  # Names of tests are indented.
  set(out)
  foreach(suite IN LISTS suites)
    string(STRIP ${suite} suite)
    string(REGEX REPLACE "\\.$" "" name ${PREFIX}.${suite})
    string(APPEND out "add_test(${name} [==[${PROGRAM}]==] --gtest_filter=${suite}*)\n"
                      "set_tests_properties(${name} PROPERTIES LABELS ${LABEL} ENVIRONMENT [==[${ENVIRONMENT}]==])\n")
  endforeach()
  file(WRITE ${FILE} "${out}")
endif()
