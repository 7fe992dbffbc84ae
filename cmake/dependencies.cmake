# This file finds the libraries as Debian 12 packages them. Comments mark where the packages need help.
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET libzstd)
pkg_check_modules(xxhash REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(zip REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(assimp REQUIRED IMPORTED_TARGET assimp)
pkg_check_modules(httplib REQUIRED IMPORTED_TARGET cpp-httplib)
pkg_check_modules(deflate REQUIRED IMPORTED_TARGET libdeflate)
find_package(glm REQUIRED)
find_package(fmt 9 CONFIG REQUIRED)
find_package(TBB 2021 CONFIG REQUIRED COMPONENTS tbb)
find_package(CLI11 CONFIG REQUIRED)
find_package(nlohmann_json 3 CONFIG REQUIRED)
find_package(embree 3.13 REQUIRED)
find_package(hwy 1 CONFIG REQUIRED)
find_package(OpenEXR 3 CONFIG REQUIRED)
find_package(TIFF 4.5 REQUIRED)
find_package(PNG REQUIRED)

# libosd-dev's CMake package stops the configuration over static libraries that it does not contain, so the shared
# library is named by hand. Elsewhere the package's own configuration is used.
find_library(OSD_CPU_LIBRARY osdCPU)
find_path(OSD_INCLUDE_DIR opensubdiv/bfr/surface.h)
if(OSD_CPU_LIBRARY AND OSD_INCLUDE_DIR)
  add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
  set_target_properties(OpenSubdiv::osdCPU PROPERTIES IMPORTED_LOCATION "${OSD_CPU_LIBRARY}"
                        INTERFACE_INCLUDE_DIRECTORIES "${OSD_INCLUDE_DIR}")
else()
  find_package(OpenSubdiv CONFIG REQUIRED)
endif()

# libopenvdb-dev has no CMake configuration, and does not depend on the headers of Boost that its own headers include.
find_library(OPENVDB_LIBRARY openvdb)
find_path(OPENVDB_INCLUDE_DIR openvdb/version.h)
find_path(BOOST_INCLUDE_DIR boost/numeric/conversion/conversion_traits.hpp)
if(NOT OPENVDB_LIBRARY OR NOT OPENVDB_INCLUDE_DIR OR NOT BOOST_INCLUDE_DIR)
  message(FATAL_ERROR "OpenVDB is not found: on Debian, install libopenvdb-dev and libboost-dev")
endif()
file(STRINGS ${OPENVDB_INCLUDE_DIR}/openvdb/version.h _vdb_version REGEX "define OPENVDB_LIBRARY_(MAJOR|MINOR|PATCH)_VERSION_NUMBER")
string(REGEX REPLACE "[^0-9;]" "" _vdb_version "${_vdb_version}")
list(JOIN _vdb_version "." _vdb_version)
add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
set_target_properties(OpenVDB::openvdb PROPERTIES IMPORTED_LOCATION ${OPENVDB_LIBRARY}
                      INTERFACE_INCLUDE_DIRECTORIES "${OPENVDB_INCLUDE_DIR};${BOOST_INCLUDE_DIR}"
                      INTERFACE_LINK_LIBRARIES "TBB::tbb;Imath::Imath")

# OpenImageIO is found by pkg-config, because the CMake package of libopenimageio-dev requires the programs of
# openimageio-tools and the headers of OpenCV (1 GB).
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET OpenImageIO>=2.4)

# Chart.js draws the curves on the pages of `tomales chart`, which contain it.
find_file(CHART_JS chart.js/chart.min.js PATHS /usr/share/javascript NO_DEFAULT_PATH)
if(NOT CHART_JS)
  message(FATAL_ERROR "Chart.js is not found: on Debian, install libjs-chart.js; elsewhere set CHART_JS to its chart.min.js")
endif()
file(STRINGS ${CHART_JS} _chart_version REGEX "Chart.js v[0-9.]+" LIMIT_COUNT 1)
string(REGEX REPLACE ".*Chart.js v([0-9.]+).*" "\\1" _chart_version "${_chart_version}")

# `tomales --version` prints these fields of each library: its name, version and licence (SPDX).
set(_osd_version "${OpenSubdiv_VERSION}")
if(NOT _osd_version)
  file(STRINGS ${OSD_INCLUDE_DIR}/opensubdiv/version.h _osd_version REGEX "define OPENSUBDIV_VERSION v")
  string(REGEX REPLACE ".*VERSION v([0-9]+)_([0-9]+)_([0-9]+).*" "\\1.\\2.\\3" _osd_version "${_osd_version}")
endif()
set(TOMALES_LIBRARIES
  "OpenSubdiv|${_osd_version}|Apache-2.0 with changes" "Embree|${embree_VERSION}|Apache-2.0"
  "OpenImageIO|${OpenImageIO_VERSION}|BSD-3-Clause" "OpenVDB|${_vdb_version}|MPL-2.0" "OpenEXR|${OpenEXR_VERSION}|BSD-3-Clause"
  "Imath|${Imath_VERSION}|BSD-3-Clause" "oneTBB|${TBB_VERSION}|Apache-2.0" "GLM|${glm_VERSION}|MIT"
  "Highway|${hwy_VERSION}|Apache-2.0" "fmt|${fmt_VERSION}|MIT" "CLI11|${CLI11_VERSION}|BSD-3-Clause"
  "JSON for Modern C++|${nlohmann_json_VERSION}|MIT" "cpp-httplib|${httplib_VERSION}|MIT" "Assimp|${assimp_VERSION}|BSD-3-Clause"
  "Chart.js|${_chart_version}|MIT"
  "LibTIFF|${TIFF_VERSION_STRING}|libtiff" "libpng|${PNG_VERSION_STRING}|libpng-2.0" "zlib|${ZLIB_VERSION_STRING}|Zlib"
  "libzip|${zip_VERSION}|BSD-3-Clause" "Zstandard|${zstd_VERSION}|BSD-3-Clause" "libdeflate|${deflate_VERSION}|MIT"
  "xxHash|${xxhash_VERSION}|BSD-2-Clause")
list(TRANSFORM TOMALES_LIBRARIES REPLACE "(.*)\\|(.*)\\|(.*)" "  \\1 \\2 (\\3)\n")
list(JOIN TOMALES_LIBRARIES "" TOMALES_LIBRARY_TEXT)
