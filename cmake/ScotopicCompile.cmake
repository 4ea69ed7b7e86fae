# Flags shared by everything built here; never exported to those who link the installed library.
add_library(scotopic_compile INTERFACE)
target_compile_options(scotopic_compile INTERFACE
  -Wall -Wextra -Wconversion -Wshadow
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

# scotopic_room(TARGET SOURCES...): adds the files of one room (folder) to its library.
function(scotopic_room target)
  list(TRANSFORM ARGN PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
  target_sources(${target} PRIVATE ${ARGN})
endfunction()
