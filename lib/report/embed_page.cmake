# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFOLDER=lib/report/page -DOUTPUT=page_text.cpp -P embed_page.cmake
# Puts styles and scripts into the pages where they name them and writes each page as a C++ string.
function(join_files variable extension)
  set(all "")
  foreach(part ${ARGN})
    file(READ ${FOLDER}/${part}.${extension} text)
    string(APPEND all "${text}")
  endforeach()
  set(${variable} "${all}" PARENT_SCOPE)
endfunction()

function(add_page name page)
  cmake_parse_arguments(arg "" "" "STYLES;SCRIPTS" ${ARGN})
  join_files(style css ${arg_STYLES})
  join_files(script js ${arg_SCRIPTS})
  file(READ ${FOLDER}/${page}.html text)
  string(REPLACE "{{style}}" "${style}" text "${text}")
  string(REPLACE "{{script}}" "${script}" text "${text}")
  file(APPEND ${OUTPUT} "const char* const ${name} = R\"~page~(${text})~page~\";\n")
endfunction()

file(WRITE ${OUTPUT} "// Made by embed_page.cmake.
#include \"report/page_text.h\"

namespace comptonaut {
")
add_page(kPageText page STYLES page SCRIPTS format colour chart map buildings marks tables page)
add_page(kComparisonText comparison STYLES page comparison SCRIPTS format colour chart quartiles buildings small_maps comparison)
file(APPEND ${OUTPUT} "}  // namespace comptonaut\n")
