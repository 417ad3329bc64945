# find_package(nacre): nacre::tester and nacre::client.
include(${CMAKE_CURRENT_LIST_DIR}/NacreLibraries.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/nacreTargets.cmake)
