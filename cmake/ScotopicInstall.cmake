# Two components, which are also the two Debian packages: the program with its looks, and what programmers need.
# What names no component belongs to the program's (CMakeLists.txt).
include(CMakePackageConfigHelpers)

if(TARGET scotopic)
  install(TARGETS scotopic RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY ocio_config luts DESTINATION ${CMAKE_INSTALL_DATADIR}/scotopic)
set(doc ${CMAKE_INSTALL_DATAROOTDIR}/doc)
install(FILES README.md CHANGELOG.md DESTINATION ${doc}/scotopic)
install(FILES LICENSE DESTINATION ${doc}/scotopic RENAME copyright)
install(FILES LICENSE DESTINATION ${doc}/libscotopic-dev RENAME copyright COMPONENT library)

install(TARGETS scotopic_core scotopic_image scotopic_ocio scotopic_host EXPORT ScotopicTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
# What others may include; all else may change without a word.
configure_file(src/scotopic/version.h.in ${PROJECT_BINARY_DIR}/include/scotopic/version.h @ONLY)
install(DIRECTORY src/scotopic/ ${PROJECT_BINARY_DIR}/include/scotopic/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/scotopic
  COMPONENT library FILES_MATCHING PATTERN "*.h" PATTERN "error.h" EXCLUDE)
install(FILES src/base/error.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/scotopic COMPONENT library)
install(EXPORT ScotopicTargets NAMESPACE scotopic:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Scotopic
  COMPONENT library)
configure_package_config_file(cmake/ScotopicConfig.cmake.in ${PROJECT_BINARY_DIR}/ScotopicConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Scotopic)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ScotopicConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ScotopicConfig.cmake ${PROJECT_BINARY_DIR}/ScotopicConfigVersion.cmake
  cmake/ScotopicDependencies.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Scotopic COMPONENT library)
# The prefix is found from where the file lies: a package, or a --prefix given later, may put it anywhere.
file(RELATIVE_PATH scotopic_pc_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/scotopic.pc.in ${PROJECT_BINARY_DIR}/scotopic.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/scotopic.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)

include(ScotopicPackage)
