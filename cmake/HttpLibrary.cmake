# SPDX-License-Identifier: BSD-2-Clause
#   pm_httplib  pbrt --serve (libcpp-httplib-dev); without it the option says what is missing
# The library is compiled with TLS and compression, and its classes are laid out by these macros, so pkg-config's flags
# are needed although neither is used.
find_package(PkgConfig)
if(PkgConfig_FOUND)
  pkg_check_modules(HTTPLIB IMPORTED_TARGET cpp-httplib)
endif()
add_library(pm_httplib INTERFACE)
if(HTTPLIB_FOUND)
  target_link_libraries(pm_httplib INTERFACE PkgConfig::HTTPLIB)
  target_compile_definitions(pm_httplib INTERFACE PBRT_MEDIA_HAS_HTTPLIB=1)
else()
  message(STATUS "cpp-httplib not found (libcpp-httplib-dev): pbrt --serve and its tests are left out")
endif()
