# Flags shared by everything built here; never exported to those who link the installed library.
add_library(scotopic_compile INTERFACE)
target_compile_options(scotopic_compile INTERFACE
  -Wall -Wextra -Wconversion
  # Of files compiled together, what one calls its own is no global of the other's.
  $<IF:$<AND:$<BOOL:${CMAKE_UNITY_BUILD}>,$<CXX_COMPILER_ID:GNU>>,-Wshadow=local,-Wshadow>
  # One multiplication, one rounding: results must not depend on what the compiler fuses.
  -ffp-contract=off
  # GCC 12 sees overlaps in std::string that are not there (its bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${SCOTOPIC_WERROR}>:-Werror>)
if(SCOTOPIC_SANITIZE)
  # float-divide-by-zero is outside "undefined": x/0 is defined by IEEE 754, but here it is a bug.
  target_compile_options(scotopic_compile INTERFACE
    -fsanitize=${SCOTOPIC_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer
    # GCC 12 takes what its own instrumentation reads of a std::optional for uninitialised.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  # RPATH, not RUNPATH: the sanitizer stands between dlopen and the program whose RUNPATH says where to look.
  target_link_options(scotopic_compile INTERFACE -fsanitize=${SCOTOPIC_SANITIZE} -Wl,--disable-new-dtags)
  # Two SIMD targets (AVX2 and the baseline) instead of five: instrumented vector code takes minutes to compile.
  target_compile_definitions(scotopic_compile INTERFACE
    "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SSE4|HWY_AVX3|HWY_AVX3_DL)")
endif()

# scotopic_room(TARGET SOURCES...): adds the files of one room (folder) to its library. With CMAKE_UNITY_BUILD they are
# compiled as one, so that their headers are read once.
function(scotopic_room target)
  list(TRANSFORM ARGN PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
  target_sources(${target} PRIVATE ${ARGN})
  file(RELATIVE_PATH room ${PROJECT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR})
  string(REPLACE "/" "_" room ${room})
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${room})
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
endfunction()

# scotopic_simd_room(TARGET SOURCES...): the same for files that include themselves once per SIMD target
# (hwy/foreach_target.h): these are always compiled one by one.
function(scotopic_simd_room target)
  scotopic_room(${target} ${ARGN})
  set_source_files_properties(${ARGN} TARGET_DIRECTORY ${target} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# scotopic_words(TARGET): for code that reads options and prints; what it does most of the time is being compiled, for the
# headers of CLI11 and JSON.
function(scotopic_words target)
  if(NOT CMAKE_UNITY_BUILD)
    target_precompile_headers(${target} PRIVATE <CLI/CLI.hpp> <fmt/format.h> <nlohmann/json.hpp>)
  endif()
  if(SCOTOPIC_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()
