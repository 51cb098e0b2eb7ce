# SPDX-License-Identifier: MIT
# embed_page.cmake - writes a page as C arrays: its HTML with the styles and scripts that it names put into it, cut in two
# at @FACTS@, where the recording's data goes. With
#   cmake -D SOURCE=page/index.html -D OUTPUT=page_html.c [-D MODULE=octreel.wasm.letters] -P embed_page.cmake
# the arrays are page_html_head and page_html_tail. A page with @MODULE@ in it also gets page_html_plays: whether there is
# a module.
cmake_minimum_required(VERSION 3.22)
get_filename_component(name ${OUTPUT} NAME_WE)
get_filename_component(folder ${SOURCE} DIRECTORY)
file(READ ${SOURCE} page)

# strip(TEXT): takes the indentation, blank lines, and comments that end a line out of a variable; a text of several
# lines would lose its indentation, so no file here has one.
macro(strip text)
  string(REGEX REPLACE "\n +" "\n" ${text} "\n${${text}}")
  string(REGEX REPLACE " */[*] [^*]*([*]+[^*/][^*]*)*[*]+/\n" "\n" ${text} "${${text}}")
  string(REGEX REPLACE "<!-- [^>]*-->\n" "" ${text} "${${text}}")
  string(REGEX REPLACE "\n\n+" "\n" ${text} "${${text}}")
endmacro()

# inline(ELEMENT REGEX): replaces each tag that the expression finds by an <ELEMENT> with the text of the file it names.
macro(inline element regex)
  string(REGEX MATCHALL "${regex}" tags "${page}")
  foreach(tag ${tags})
    string(REGEX REPLACE "${regex}" "\\1" part "${tag}")
    file(READ ${folder}/${part} text)
    if(text MATCHES "</${element}")
      message(FATAL_ERROR "${part}: \"</${element}\" would close the element that holds this file")
    endif()
    strip(text)
    string(REGEX REPLACE "[ \n]*([{}])" "\\1" text "${text}") # no string of JavaScript or CSS here has a blank there
    string(REGEX REPLACE "([(,;{])\n" "\\1" text "${text}")
    if("${element}" STREQUAL "style")
      string(REPLACE ": " ":" text "${text}")
    endif()
    string(REPLACE "${tag}" "<${element}>${text}</${element}>" page "${page}")
  endforeach()
endmacro()
strip(page)
string(REGEX REPLACE "^\n" "" page "${page}")
inline(style "<link rel=\"stylesheet\" href=\"([^\"]*)\">")
inline(script "<script src=\"([^\"]*)\"></script>")

# Without a module its element stays empty.
set(module "")
if(MODULE)
  file(READ ${MODULE} module)
endif()
string(FIND "${page}" "@MODULE@" takes_module)
string(REPLACE "@MODULE@" "${module}" page "${page}")

string(FIND "${page}" "@FACTS@" cut)
if(cut EQUAL -1)
  message(FATAL_ERROR "${SOURCE}: has no @FACTS@, the place for the data of a recording")
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
