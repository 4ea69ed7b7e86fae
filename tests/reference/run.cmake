# Makes the reference; fails on any warning but that of a data member without a comment.
#   cmake -D DOXYGEN=... -D DOXYFILE=... -D REFERENCE=... -P run.cmake
file(REMOVE_RECURSE ${REFERENCE})
file(MAKE_DIRECTORY ${REFERENCE})
execute_process(COMMAND ${DOXYGEN} ${DOXYFILE} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
file(STRINGS ${REFERENCE}/warnings.txt warnings)
list(FILTER warnings EXCLUDE REGEX "Member .* [(]variable[)] of .* is not documented[.]$")
if(result OR warnings)
  list(JOIN warnings "\n" warnings)
  message(FATAL_ERROR "${out}${warnings}")
endif()
# That it read what it should: a class of the first room and one of the last are there.
foreach(page classscotopic_1_1Kernel structscotopic_1_1LookSpec)
  if(NOT EXISTS ${REFERENCE}/html/${page}.html)
    message(FATAL_ERROR "the reference lacks ${page}")
  endif()
endforeach()
