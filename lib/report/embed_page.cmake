# SPDX-License-Identifier: BSD-3-Clause
# cmake -DFOLDER=lib/report/page -DOUTPUT=page_text.cpp -P embed_page.cmake
# Puts the style and the scripts into page.html where it names them and writes the whole as a C++ string.
file(READ ${FOLDER}/page.html page)
file(READ ${FOLDER}/page.css style)
set(script "")
foreach(part format colour chart map marks tables page)
  file(READ ${FOLDER}/${part}.js text)
  string(APPEND script "${text}")
endforeach()
string(REPLACE "{{style}}" "${style}" page "${page}")
string(REPLACE "{{script}}" "${script}" page "${page}")
file(WRITE ${OUTPUT} "// Made by embed_page.cmake.
#include \"report/page_text.h\"

namespace comptonaut {
const char* const kPageText = R\"~page~(${page})~page~\";
}  // namespace comptonaut
")
