# Turns CSV tables into C++: no table is read when the program runs.
#
#   scotopic_embed_tables(OUT.cpp a.csv b.csv ...)      in a CMakeLists.txt
#   cmake -DOUTPUT=... -DTABLES=a.csv;b.csv -P EmbedTables.cmake    at build time, when a CSV changed
#
# A CSV has '#' lines of source, a line of column names "nm,...", then rows of evenly spaced wavelengths.
# Column c of file f.csv becomes `const TabulatedCurve f_c{first_nm, step_nm, values}`.

function(scotopic_embed_tables output)
  set(tables ${ARGN})
  list(TRANSFORM tables PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
  set(script ${PROJECT_SOURCE_DIR}/cmake/EmbedTables.cmake)
  string(REPLACE ";" "|" joined "${tables}")
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} "-DTABLES=${joined}" -P ${script}
    DEPENDS ${tables} ${script}
    COMMENT "Embedding receptor tables" VERBATIM)
endfunction()

function(table_to_cpp table result)
  get_filename_component(name ${table} NAME_WE)
  file(STRINGS ${table} lines REGEX "^[^#]")
  list(POP_FRONT lines header)
  string(REPLACE "," ";" columns "${header}")
  list(POP_FRONT columns)
  list(LENGTH columns width)
  set(number "[-+.0-9eE]+")
  set(wavelengths "")
  foreach(column ${columns})
    set(values_${column} "")
  endforeach()
  foreach(line ${lines})
    if(NOT line MATCHES "^${number}(,${number})+$")
      message(FATAL_ERROR "${table}: not a row of numbers: ${line}")
    endif()
    string(REPLACE "," ";" cells "${line}")
    list(LENGTH cells cell_count)
    math(EXPR expected "${width} + 1")
    if(NOT cell_count EQUAL expected)
      message(FATAL_ERROR "${table}: ${expected} columns expected: ${line}")
    endif()
    list(POP_FRONT cells nm)
    list(APPEND wavelengths ${nm})
    foreach(column value IN ZIP_LISTS columns cells)
      string(APPEND values_${column} "${value}, ")
    endforeach()
  endforeach()
  list(GET wavelengths 0 first)
  list(GET wavelengths 1 second)
  math(EXPR step "${second} - ${first}")
  set(next ${first})
  foreach(nm ${wavelengths})
    if(NOT nm EQUAL next)
      message(FATAL_ERROR "${table}: wavelengths are not evenly spaced at ${nm}")
    endif()
    math(EXPR next "${nm} + ${step}")
  endforeach()
  set(text "")
  foreach(column ${columns})
    string(APPEND text "constexpr double ${name}_${column}_values[] = {${values_${column}}};\n"
      "constinit const TabulatedCurve ${name}_${column}{${first}, ${step}, ${name}_${column}_values};\n")
  endforeach()
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  string(REPLACE "|" ";" TABLES "${TABLES}")
  set(body "")
  foreach(table ${TABLES})
    table_to_cpp(${table} text)
    string(APPEND body "${text}")
  endforeach()
  file(WRITE ${OUTPUT} "// Made by cmake/EmbedTables.cmake from src/receptors/tables: edit those.\n"
    "#include \"receptors/tables.h\"\n\nnamespace scotopic::tables {\n${body}}  // namespace scotopic::tables\n")
endif()
