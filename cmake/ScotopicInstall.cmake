include(CMakePackageConfigHelpers)

install(TARGETS scotopic_core scotopic_image scotopic_ocio EXPORT ScotopicTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET scotopic)
  install(TARGETS scotopic RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY src/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/scotopic
  FILES_MATCHING PATTERN "*.h" PATTERN "cli" EXCLUDE PATTERN "*-inl.h" EXCLUDE)
install(DIRECTORY ocio_config luts DESTINATION ${CMAKE_INSTALL_DATADIR}/scotopic)
install(EXPORT ScotopicTargets NAMESPACE scotopic:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Scotopic)
configure_package_config_file(cmake/ScotopicConfig.cmake.in ${PROJECT_BINARY_DIR}/ScotopicConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Scotopic)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ScotopicConfigVersion.cmake
  COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ScotopicConfig.cmake ${PROJECT_BINARY_DIR}/ScotopicConfigVersion.cmake
  cmake/ScotopicDependencies.cmake DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/Scotopic)
