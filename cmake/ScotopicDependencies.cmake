# What the libraries link; included here and by ScotopicConfig.cmake of an installation.
find_package(Threads REQUIRED)
find_package(hwy REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenEXR 3.1 REQUIRED)
# Not find_package's own comparison: OpenImageIO's package calls 3.x incompatible with who asks for 2.4.
find_package(OpenImageIO REQUIRED)
if(OpenImageIO_VERSION VERSION_LESS 2.4)
  message(FATAL_ERROR "OpenImageIO 2.4 or later is needed; ${OpenImageIO_DIR} has ${OpenImageIO_VERSION}")
endif()
# Debian's package of it names OpenCV's headers, which it neither needs nor brings along.
foreach(target OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
  get_target_property(directories ${target} INTERFACE_INCLUDE_DIRECTORIES)
  if(directories)
    list(FILTER directories EXCLUDE REGEX "opencv")
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${directories}")
  endif()
endforeach()
# By pkg-config: Debian 12's CMake package of OpenColorIO names an include folder that does not exist.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OpenColorIO REQUIRED IMPORTED_TARGET GLOBAL OpenColorIO>=2.1)
pkg_check_modules(lcms2 REQUIRED IMPORTED_TARGET GLOBAL lcms2>=2.12)
