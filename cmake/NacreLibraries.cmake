# What nacre's installed libraries link to, all from Debian's packages. Installed beside nacreConfig.cmake: whoever
# links to nacre needs the same.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(tl-expected REQUIRED)
find_package(NLopt REQUIRED)
find_package(ZLIB REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET GLOBAL tomlplusplus)
pkg_check_modules(zstd REQUIRED IMPORTED_TARGET GLOBAL libzstd)

find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
find_library(XXHASH_LIBRARY xxhash REQUIRED)
# Debian's LCM 1.3.1 has no CMake package and its pkg-config file needs glib's development files.
find_path(LCM_INCLUDE_DIR lcm/lcm-cpp.hpp REQUIRED)
find_library(LCM_LIBRARY lcm REQUIRED)
if(NOT TARGET lcm::lcm)
  add_library(xxhash::xxhash UNKNOWN IMPORTED GLOBAL)
  set_target_properties(xxhash::xxhash PROPERTIES IMPORTED_LOCATION ${XXHASH_LIBRARY}
                                                  INTERFACE_INCLUDE_DIRECTORIES ${XXHASH_INCLUDE_DIR})
  add_library(lcm::lcm UNKNOWN IMPORTED GLOBAL)
  set_target_properties(lcm::lcm PROPERTIES IMPORTED_LOCATION ${LCM_LIBRARY}
                                            INTERFACE_INCLUDE_DIRECTORIES ${LCM_INCLUDE_DIR})
endif()
