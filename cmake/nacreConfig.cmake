# find_package(nacre): nacre::tester.
include(${CMAKE_CURRENT_LIST_DIR}/NacreLibraries.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/nacreTargets.cmake)
