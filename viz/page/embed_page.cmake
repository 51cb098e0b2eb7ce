# SPDX-License-Identifier: MIT
# embed_page.cmake - a page as C arrays: the HTML with its style and scripts put where it names them, cut in two where
# facts go.  cmake -D SOURCE=page/index.html -D OUTPUT=page_html.c -P embed_page.cmake  makes page_html_head and
# page_html_tail, and of a page that takes @MODULE@ page_html_plays, which page_html.h declares.
cmake_minimum_required(VERSION 3.22)
get_filename_component(name ${OUTPUT} NAME_WE)
get_filename_component(folder ${SOURCE} DIRECTORY)
file(READ ${SOURCE} page)

# inline(ELEMENT REGEX): each tag that the expression finds becomes an <ELEMENT> with the text of the file it names. What
# lines are indented by is left out, as are blank lines and comments that begin a line: no text in these files goes on
# over lines.
macro(inline element regex)
  string(REGEX MATCHALL "${regex}" tags "${page}")
  foreach(tag ${tags})
    string(REGEX REPLACE "${regex}" "\\1" part "${tag}")
    file(READ ${folder}/${part} text)
    if(text MATCHES "</${element}")
      message(FATAL_ERROR "${part}: \"</${element}\" would end the element that it is put into")
    endif()
    string(REGEX REPLACE "\n +" "\n" text "\n${text}")
    string(REGEX REPLACE "\n/[*][^*]*([*]+[^*/][^*]*)*[*]+/" "" text "${text}")
    string(REGEX REPLACE "\n\n+" "\n" text "${text}")
    string(REPLACE "${tag}" "<${element}>${text}</${element}>" page "${page}")
  endforeach()
endmacro()
inline(style "<link rel=\"stylesheet\" href=\"([^\"]*)\">")
inline(script "<script src=\"([^\"]*)\"></script>")

# The module's place stays empty where none was built.
set(module "")
if(MODULE)
  file(READ ${MODULE} module)
endif()
string(FIND "${page}" "@MODULE@" takes_module)
string(REPLACE "@MODULE@" "${module}" page "${page}")

string(FIND "${page}" "@FACTS@" cut)
if(cut EQUAL -1)
  message(FATAL_ERROR "${SOURCE}: there is no @FACTS@")
endif()
math(EXPR behind "${cut} + 7")
string(SUBSTRING "${page}" 0 ${cut} head)
string(SUBSTRING "${page}" ${behind} -1 tail)

include(${CMAKE_CURRENT_LIST_DIR}/../c_bytes.cmake)
set(source "#include \"${name}.h\"\n")
foreach(part head tail)
  string(HEX "${${part}}" bytes)
  c_bytes(bytes "${bytes}")
  string(APPEND source "\nconst unsigned char ${name}_${part}[] = {\n${bytes}\n};\n"
                       "const size_t ${name}_${part}_size = sizeof ${name}_${part};\n")
endforeach()
if(NOT takes_module EQUAL -1)
  string(COMPARE NOTEQUAL "${module}" "" plays)
  string(APPEND source "\nconst bool ${name}_plays = ${plays};\n")
endif()
file(WRITE ${OUTPUT} "${source}")
