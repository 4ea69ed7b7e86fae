# What the libraries link; included here and by ScotopicConfig.cmake of an installation.
find_package(Threads REQUIRED)
find_package(hwy REQUIRED)
find_package(fmt REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(OpenEXR 3.1 REQUIRED)
find_package(OpenImageIO 2.4 REQUIRED)
# Debian puts this one outside the folders CMake searches by itself.
find_package(OpenColorIO 2.1 REQUIRED PATHS /usr/share/cmake)
