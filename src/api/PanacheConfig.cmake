include(${CMAKE_CURRENT_LIST_DIR}/PanacheTargets.cmake)
# The static library leaves its kernels' dispatch to Highway.
find_package(hwy QUIET)
if(hwy_FOUND)
  include(${CMAKE_CURRENT_LIST_DIR}/PanacheStaticTargets.cmake)
endif()
