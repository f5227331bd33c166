# For cross builds: for Windows with MinGW, or for another processor. Debian has no libraries for
# these targets, so the build uses header-only ones in a folder of their own; all of /usr/include
# would hide the target's headers. Highway is header-only with a single instruction set, the
# compiler's.
set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
foreach(name hwy fast_float nlohmann CLI)
  find_path(${name}_parent ${name} PATHS /usr/include /usr/local/include NO_CMAKE_FIND_ROOT_PATH
    REQUIRED)
  file(CREATE_LINK ${${name}_parent}/${name} ${headers}/${name} SYMBOLIC)
endforeach()
include_directories(SYSTEM ${headers})
# What find_package finds instead of the system's packages.
foreach(target FastFloat::fast_float hwy::hwy nlohmann_json::nlohmann_json CLI11::CLI11)
  string(REGEX REPLACE ":.*" "" package ${target})
  string(TOLOWER ${package} package)
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}-config.cmake
    "if(NOT TARGET ${target})\n  add_library(${target} INTERFACE IMPORTED GLOBAL)\nendif()\n")
endforeach()
add_compile_definitions(HWY_COMPILE_ONLY_STATIC)
if(WIN32)
  add_compile_definitions(NOMINMAX)
  # Programs need no DLLs except those of Windows and, if they use it, ours.
  add_link_options(-static)
endif()
