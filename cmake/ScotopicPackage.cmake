# Debian packages, by `cpack -G DEB` in the build folder: scotopic (program, looks), libscotopic-dev
# (headers, static libraries, CMake and pkg-config files), and where they are built python3-scotopic. tests/package takes them apart and runs them.
set(CPACK_PACKAGE_NAME scotopic)
set(CPACK_PACKAGE_CONTACT "The Scotopic authors <maintainers@scotopic.invalid>")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_COMPONENTS_ALL program library)
set(CPACK_COMPONENTS_GROUPING IGNORE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME scotopic)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
# What the program and its module link is found by dpkg-shlibdeps.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
# The first line of a package's description is the project's.
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
"Computes what rods do to colour, luminance and detail in dim light, exactly,
for images of known adaptation luminance; bakes the same as OpenColorIO looks.
With an OpenColorIO config of ready-made looks.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libscotopic-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
# The program's package holds the module that reads TIFF, PNG, JPEG and HDR.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "scotopic (= ${PROJECT_VERSION}), libopencolorio-dev (>= 2.1), \
libopenimageio-dev (>= 2.4), libopenexr-dev (>= 3.1), liblcms2-dev, libssl-dev, libhwy-dev, libfmt-dev, nlohmann-json3-dev, pkg-config")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
"Development files: static libraries, headers, and files for CMake and pkg-config, to use the
operator and its looks in other programs.")

if(TARGET scotopic_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-scotopic)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  # A module is for one version of the interpreter: the next is one too many.
  string(REGEX REPLACE "^([0-9]+)[.].*" "\\1" python_major ${SCOTOPIC_PYTHON_VERSION})
  string(REGEX REPLACE "^[0-9]+[.]" "" python_minor ${SCOTOPIC_PYTHON_VERSION})
  math(EXPR python_minor "${python_minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= ${SCOTOPIC_PYTHON_VERSION}), python3 (<< ${python_major}.${python_minor}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "scotopic, python3-openimageio")
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
"Module for Python: the operator on numpy arrays, byte for byte the program's results;
receptors, mesopic photometry, thresholds and adaptation in time.")
endif()
if(TARGET scotopic_ofx)
  list(APPEND CPACK_COMPONENTS_ALL ofx)
  set(CPACK_DEBIAN_OFX_PACKAGE_NAME scotopic-ofx)
  set(CPACK_DEBIAN_OFX_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_OFX_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_OFX_PACKAGE_SUGGESTS scotopic)
  set(CPACK_COMPONENT_OFX_DESCRIPTION
"Plug-in for OpenFX hosts (Nuke, Resolve, Natron): the operator with detail, glare, noise
and adaptation in time, byte for byte the program's results.")
endif()
include(CPack)
