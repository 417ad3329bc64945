# What `cmake --install` puts under PREFIX, and what `cpack -G DEB` packs (needs dpkg-dev). Programs find share/nacre
# beside their bin/ (base/shipped_files.hpp): PREFIX may be moved.
# The networks (libtorch) stay out: only studies use them.
include(GNUInstallDirs)
set(shipped ${CMAKE_INSTALL_DATADIR}/nacre)

install(TARGETS nacre nacre_proposal_agent nacre_validation_agent nacre_simulator_farm nacre_analyser nacre_virtual_lab
        RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY data DESTINATION ${shipped})
install(DIRECTORY launch DESTINATION ${shipped} FILES_MATCHING PATTERN "*.toml" PATTERN "README.md")
install(DIRECTORY lcmtypes DESTINATION ${shipped} FILES_MATCHING PATTERN "*.lcm" PATTERN "README.md")
install(FILES ${PROJECT_BINARY_DIR}/commit DESTINATION ${shipped})
install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/ DESTINATION ${CMAKE_INSTALL_DATADIR})
# Debian's zsh looks here in /usr, in zsh/site-functions only in /usr/local.
install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/zsh/site-functions/
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DOCDIR}
        FILES_MATCHING PATTERN "studies" EXCLUDE PATTERN "*.md" PATTERN "*.gif" PATTERN "*.png")

# Debian's Python looks here in /usr; under another prefix PYTHONPATH names the folder. What plays does not need it.
if(NACRE_PYTHON)
  install(TARGETS nacre_python LIBRARY DESTINATION lib/python3/dist-packages/nacre OPTIONAL)
  install(CODE "if(NOT EXISTS \"$<TARGET_FILE:nacre_python>\")
    message(STATUS \"without the Python module: cmake --build build --target nacre_python makes it\")
  endif()")
  install(DIRECTORY nodes/python/nacre/ DESTINATION lib/python3/dist-packages/nacre)
endif()

# The page is bundled by npm, without which all but `nacre dashboard` works.
install(DIRECTORY ${PROJECT_BINARY_DIR}/web/ DESTINATION ${shipped}/web OPTIONAL)
install(CODE "if(NOT EXISTS \"${PROJECT_BINARY_DIR}/web/index.html\")
  message(STATUS \"without the dashboard's page: npm --prefix web ci && npm --prefix web run build makes it\")
endif()")

include(NacreInstallLibraries)

set(CPACK_INSTALL_CMAKE_PROJECTS "${PROJECT_BINARY_DIR};nacre;Unspecified;/") # without the component `libraries`
set(CPACK_PACKAGE_NAME nacre)
set(CPACK_PACKAGE_CONTACT "nacre <nacre@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Discovery of stiff and tough two-material microstructures")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS iproute2)
set(CPACK_GENERATOR DEB)
include(CPack)
