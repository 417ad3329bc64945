# What find_package(nacre) finds: nacre::tester and nacre::client, the libraries that they need, and the headers that a
# program of one's own includes. They are no part of the Debian package, which is for playing.
set(modules base thesis pattern material optimize fem tester crack measurement surrogate sysid explore game wire runtime
            client)
set(headers
    base/random.hpp base/result.hpp
    thesis/constants.hpp
    pattern/design.hpp pattern/layout.hpp
    material/failure_criterion.hpp material/parameters.hpp
    tester/curve.hpp tester/loading.hpp tester/modulus.hpp tester/names.hpp tester/simulation.hpp tester/tensile.hpp
    tester/toughness.hpp
    measurement/specimen_record.hpp
    client/client.hpp)

list(TRANSFORM modules PREPEND nacre_)
install(TARGETS ${modules} nacre_lcmtypes EXPORT nacre COMPONENT libraries
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/nacre)
foreach(header ${headers})
  cmake_path(GET header PARENT_PATH folder)
  install(FILES lib/${header} DESTINATION ${NACRE_INCLUDE_FOLDER}/${folder} COMPONENT libraries)
endforeach()

include(CMakePackageConfigHelpers)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nacreConfigVersion.cmake COMPATIBILITY SameMinorVersion)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/nacre)
install(EXPORT nacre FILE nacreTargets.cmake NAMESPACE nacre:: DESTINATION ${package} COMPONENT libraries)
install(FILES cmake/nacreConfig.cmake cmake/NacreLibraries.cmake ${PROJECT_BINARY_DIR}/nacreConfigVersion.cmake
        DESTINATION ${package} COMPONENT libraries)
