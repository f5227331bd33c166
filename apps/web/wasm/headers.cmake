# Collects the library's third-party system headers in a separate folder: including all of
# /usr/include would shadow Emscripten's headers.
set(headers ${CMAKE_BINARY_DIR}/headers)
foreach(name hwy fast_float nlohmann)
  find_path(${name}_parent ${name} PATHS /usr/include /usr/local/include NO_CMAKE_FIND_ROOT_PATH
    REQUIRED)
  file(MAKE_DIRECTORY ${headers})
  file(CREATE_LINK ${${name}_parent}/${name} ${headers}/${name} SYMBOLIC)
endforeach()
include_directories(SYSTEM ${headers})
add_compile_options(-include ${CMAKE_CURRENT_LIST_DIR}/missing_std.h)
# find_package gets these targets instead of the system's, which point to /usr/include.
foreach(target FastFloat::fast_float nlohmann_json::nlohmann_json)
  string(REGEX REPLACE ":.*" "" package ${target})
  string(TOLOWER ${package} package)
  file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}-config.cmake
    "if(NOT TARGET ${target})\n  add_library(${target} INTERFACE IMPORTED GLOBAL)\nendif()\n")
endforeach()
