# tomales_page(FUNCTION FILE...): makes FUNCTION.cpp in the build folder. Its FUNCTION(), which reyes/app/page_files.h
# declares, returns the text of these files, so that pages are part of the program.
function(tomales_page function)
  set(texts "")
  foreach(file IN LISTS ARGN)
    get_filename_component(name ${file} NAME)
    file(READ ${file} text)
    string(APPEND texts "    {\"${name}\", R\"PAGE(${text})PAGE\"},\n")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  endforeach()
  configure_file(${CMAKE_SOURCE_DIR}/cmake/page_files.cpp.in ${CMAKE_BINARY_DIR}/${function}.cpp @ONLY)
  set_source_files_properties(${CMAKE_BINARY_DIR}/${function}.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
