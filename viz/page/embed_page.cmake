# SPDX-License-Identifier: MIT
# embed_page.cmake - writes a page as C arrays: its HTML with the styles and scripts that it names put into it, cut in two
# at @FACTS@, where the recording's data goes. With
#   cmake -D SOURCE=page/index.html -D OUTPUT=page_html.c [-D MODULE=octreel.wasm.letters] -P embed_page.cmake
# the arrays are page_html_head and page_html_tail. A page with @MODULE@ in it also gets page_html_plays: whether there is
# a module. With a module the styles and scripts marked data-packed are compressed, too: that makes them three times
# smaller; and page.c compresses the facts. Without one all is plain, since packing scripts needs tools that only a build
# with a module needs.
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

# allow(PLACE TEXT): appends the hash of a script or style to the content security policy, before @PLACE@.
function(allow place text)
  set(digits ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/)
  string(SHA256 hash "${text}")
  set(letters "")
  foreach(at RANGE 0 60 6) # base64: 3 bytes, which are 6 hexadecimal digits, give 4 letters
    string(SUBSTRING "${hash}0000" ${at} 6 group)
    foreach(shift 18 12 6 0)
      math(EXPR digit "(0x${group} >> ${shift}) & 63")
      string(SUBSTRING ${digits} ${digit} 1 letter)
      string(APPEND letters ${letter})
    endforeach()
  endforeach()
  string(SUBSTRING ${letters} 0 43 letters)
  string(REPLACE "@${place}@" "'sha256-${letters}=' @${place}@" allowed "${page}")
  set(page "${allowed}" PARENT_SCOPE)
endfunction()

# pack(TEXT): compresses the text in a variable with module/pack_module.
macro(pack text)
  file(WRITE ${OUTPUT}.scripts "${${text}}")
  execute_process(COMMAND sh ${CMAKE_CURRENT_LIST_DIR}/module/pack_module ${OUTPUT}.scripts OUTPUT_VARIABLE ${text}
                  RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "a part of ${SOURCE} cannot be compressed; is gzip and basenc installed?")
  endif()
endmacro()

# inline(ELEMENT REGEX [ATTRIBUTES]): replaces the tags that the expression finds by one <ELEMENT> with the texts of the
# files they name. With attributes the text is packed, in a script element: browsers would check a packed style against
# the content security policy.
macro(inline element regex)
  set(holder ${element})
  if(NOT "${ARGN}" STREQUAL "")
    set(holder script)
  endif()
  string(REGEX MATCHALL "${regex}" tags "${page}")
  set(texts "")
  foreach(tag ${tags})
    string(REGEX REPLACE "${regex}" "\\1" part "${tag}")
    file(READ ${folder}/${part} text)
    if(text MATCHES "</${element}")
      message(FATAL_ERROR "${part}: \"</${element}\" would close the element that holds this file")
    endif()
    strip(text)
    string(REGEX REPLACE "[ \n]*([{}])" "\\1" text "${text}") # no string of JavaScript or CSS here has a blank there
    string(REGEX REPLACE "([(,;{])\n" "\\1" text "${text}")
    string(REPLACE " = " "=" text "${text}") # no string here has this
    if("${element}" STREQUAL "style")
      string(REPLACE ": " ":" text "${text}")
      string(REGEX REPLACE "([{;,}])[ \n]+" "\\1" text "${text}") # no string in CSS here has a blank there
      string(REPLACE ";}" "}" text "${text}")
    endif()
    string(APPEND texts "${text}")
    list(GET tags -1 last)
    if("${tag}" STREQUAL "${last}")
      allow(${element}s "${texts}")
      if(NOT "${ARGN}" STREQUAL "")
        pack(texts)
      endif()
      string(REPLACE "${tag}" "<${holder}${ARGN}>${texts}</${holder}>" page "${page}")
    else()
      string(REPLACE "${tag}\n" "" page "${page}")
    endif()
  endforeach()
endmacro()
strip(page)
string(REGEX REPLACE "^\n" "" page "${page}")
if(page MATCHES "<script>([^<]+)</script>")
  allow(scripts "${CMAKE_MATCH_1}")
endif()
if(MODULE)
  inline(style "<link data-packed rel=\"stylesheet\" href=\"([^\"]*)\">" " type=\"application/gzip;z85\" id=\"styles\"")
  inline(script "<script data-packed src=\"([^\"]*)\"></script>" " type=\"application/gzip;z85\" id=\"scripts\"")
  string(REPLACE "application/x-ndjson\" id=\"facts" "application/gzip;z85\" id=\"facts" page "${page}")
else()
  string(REPLACE "<script src=\"unpack.js\"></script>\n" "" page "${page}")
  string(REPLACE "<script data-packed src=" "<script src=" page "${page}")
  string(REPLACE "<link data-packed rel=" "<link rel=" page "${page}")
endif()
inline(style "<link rel=\"stylesheet\" href=\"([^\"]*)\">")
inline(script "<script src=\"([^\"]*)\"></script>")
string(REGEX REPLACE " @(scripts|styles)@" "" page "${page}")

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
