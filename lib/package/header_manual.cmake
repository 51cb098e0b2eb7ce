# SPDX-License-Identifier: MIT
# Run by CMake: write OUTPUT, the manual NAME(3), from the comments in HEADER and, if it includes that, in the types.h
# beside it. The first C program in EXAMPLE that begins by including HEADER becomes the example; VERSION and DATE are
# those of the library.
cmake_policy(VERSION 3.22)
file(READ ${HEADER} text)
cmake_path(GET HEADER PARENT_PATH folder)
cmake_path(GET HEADER STEM stem)
file(READ ${folder}/types.h types)
string(REGEX REPLACE "^/\\*[^\n]*\n/\\*[^/]*\\*/\n" "" types "${types}")
string(REPLACE "#include \"octree/types.h\"\n" "${types}" text "${text}")
file(READ ${EXAMPLE} example)

# escape(TEXT): as troff has it. Until all is written other characters stand for those that part CMake's lists.
string(ASCII 1 semicolon)
string(ASCII 2 open)
string(ASCII 3 close)
function(escape variable)
  set(text "${${variable}}")
  string(REPLACE "\\" "\\e" text "${text}")
  string(REPLACE "-" "\\-" text "${text}")
  string(REPLACE "^" "\\(ha" text "${text}")
  string(REPLACE "±" "\\(+-" text "${text}")
  string(REPLACE ";" "${semicolon}" text "${text}")
  string(REPLACE "[" "${open}" text "${text}")
  string(REPLACE "]" "${close}" text "${text}")
  string(REGEX REPLACE "(^|\n)([.'])" "\\1\\\\&\\2" text "${text}")
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()
escape(text)
string(FIND "${example}" "\n```c\n#include <octree/${stem}.h>" begin)
string(SUBSTRING "${example}" ${begin} -1 example)
string(REGEX REPLACE "^\n```c\n([^`]*)```.*" "\\1" example "${example}")
escape(example)

# The prototype of a function, in lines that are not long.
function(wrap variable)
  string(REGEX REPLACE "\n +" " " words "${${variable}}")
  string(REPLACE ", " ",;" words "${words}")
  set(line "")
  set(lines "")
  foreach(word ${words})
    string(LENGTH "${line} ${word}" length)
    if(line AND length GREATER 74)
      string(APPEND lines "${line}\n")
      set(line "       ")
    endif()
    string(APPEND line " ${word}")
  endforeach()
  string(REGEX REPLACE "^ " "" lines "${lines}${line}")
  string(REPLACE "\n " "\n" lines "${lines}")
  set(${variable} "${lines}" PARENT_SCOPE)
endfunction()

# add_name(CODE): a declaration in bold, and what was said about it before.
macro(add_name code)
  string(APPEND page ".PP\n.EX\n\\fB${code}\\fR\n.EE\n")
  if(said)
    string(REPLACE "\n\n" "\n.PP\n" said "${said}")
    string(APPEND page ".RS 4\n${said}\n.RE\n")
  endif()
endmacro()

# ---- The head: what the header says of itself -----------------------------------------------------------------------

string(REGEX MATCH "/\\* ${stem}\\.h \\\\- (a [^\n]*)\\.\n([^/]*)\n \\*/" head "${text}")
set(line "${CMAKE_MATCH_1}")
string(REGEX REPLACE "\n \\* ?" "\n" about "\n${CMAKE_MATCH_2}")
string(REGEX REPLACE "^ \\*\n|^\n+" "" about "${about}")
string(REGEX REPLACE "\n  \\\\- " "\n.IP \\\\(bu 2\n" about "${about}")
string(REGEX REPLACE "\n    " "\n" about "${about}")
string(REGEX REPLACE "\n\n(Conventions)\n" "\n.SS \\1\n" about "${about}")
string(REPLACE "\n\n" "\n.PP\n" about "${about}")
set(page ".TH ${NAME} 3 ${DATE} \"Octree ${VERSION}\" Octree
.nr HY 0
.ad l
.SH NAME
${NAME} \\- ${line}
.SH SYNOPSIS
.EX
\\fB#include <octree/${stem}.h>\\fR

cc \\fIprogram.c\\fR $(pkg\\-config \\-\\-cflags \\-\\-libs octree)
.EE
.SH DESCRIPTION
${about}
")

# ---- Each declaration -----------------------------------------------------------------------------------------------

string(LENGTH "${head}" length)
string(FIND "${text}" "${head}" begin)
math(EXPR begin "${begin} + ${length}")
string(SUBSTRING "${text}" ${begin} -1 text)
string(REPLACE "\n" ";" lines "${text}")
set(said "")  # in the comment before
set(code "")  # a declaration that goes on
set(inside "") # of what a line is a part: comment, code, members, member
set(statuses "")
foreach(line IN LISTS lines)
  string(REGEX REPLACE " *\\*/$" "" ended "${line}") # without the end of a comment
  if(inside STREQUAL "comment")
    string(REGEX REPLACE "^ \\*? ?" "\n" ended "${ended}")
    string(APPEND said "${ended}")
    if(line MATCHES "\\*/$")
      set(inside "")
    endif()
  elseif(inside STREQUAL "member")
    string(REGEX REPLACE "^ +(\\* )?" "" ended "${ended}")
    string(APPEND members "${ended}\n")
    if(line MATCHES "\\*/$")
      set(inside members)
    endif()
  elseif(inside STREQUAL "members")
    if(line MATCHES "^} ([a-z_]+)")
      add_name("${code} ${CMAKE_MATCH_1}${semicolon}")
      if(members)
        string(APPEND page ".RS 4\n${members}.RE\n")
      endif()
      set(code "")
      set(inside "")
      set(said "")
    elseif(ended MATCHES "^ +([^/# ][^/]*[^ /]) +/\\* (.*)$")
      string(APPEND members ".TP\n\\fB${CMAKE_MATCH_1}\\fR\n${CMAKE_MATCH_2}\n")
      if(NOT line MATCHES "\\*/$")
        set(inside member)
      endif()
    elseif(NOT line MATCHES "_MAP|_COUNT$|_KINDS$" AND line MATCHES "^ +([^/# ][^/]*)$")
      string(APPEND members ".TP\n\\fB${CMAKE_MATCH_1}\\fR\n\\&\n")
    endif()
  elseif(inside STREQUAL "code")
    string(APPEND code "\n${line}")
  elseif(line MATCHES "^/\\* \\\\-\\\\-\\\\-\\\\- ([A-Za-z ]+) ")
    string(APPEND page ".SH \"${CMAKE_MATCH_1}\"\n")
    set(said "")
  elseif(ended MATCHES "^/\\* (.*)$")
    set(said "${CMAKE_MATCH_1}")
    if(NOT line MATCHES "\\*/$")
      set(inside comment)
    endif()
  elseif(line STREQUAL "")
    set(said "")
  elseif(line MATCHES "^#define (OCTREE_[A-Z_]+ [^\\]+)$")
    add_name("#define ${CMAKE_MATCH_1}")
    set(said "")
  elseif(line MATCHES "^ +X\\(([A-Z_]+), \"[a-z_]+\", +\"([^\"]+)\"")
    string(APPEND statuses ".TP\n\\fBOCTREE_${CMAKE_MATCH_1}\\fR\n${CMAKE_MATCH_2}\n")
  elseif(line MATCHES "^(typedef (struct|enum) [a-z_]+) {$")
    set(code "${CMAKE_MATCH_1}")
    set(inside members)
    set(members "")
  elseif(line MATCHES "^[a-z]" AND NOT line MATCHES "^extern")
    set(code "${line}")
    set(inside code)
  endif()
  if(inside STREQUAL "code" AND line MATCHES "${semicolon}$")
    wrap(code)
    add_name("${code}")
    set(code "")
    set(inside "")
    set(said "")
  endif()
endforeach()

if(statuses)
  string(APPEND page ".SH \"RETURN VALUE\"
Every function that can fail returns an octree_status:
${statuses}")
else()
  string(APPEND page ".SH \"RETURN VALUE\"
Every function that can fail returns an octree_status; octree(3) lists them.
")
endif()
string(APPEND page ".SH EXAMPLES
.EX
${example}.EE
.SH \"SEE ALSO\"
.BR octree (3),
.BR octree_bodies (3),
.BR octreel (1),
.BR octreel\\-session (5)
")
string(REGEX REPLACE "(\n\\.SH [^\n]*)\n\\.PP" "\\1" page "${page}") # which begins a paragraph itself
string(REPLACE "${semicolon}" ";" page "${page}")
string(REPLACE "${open}" "[" page "${page}")
string(REPLACE "${close}" "]" page "${page}")
file(WRITE ${OUTPUT} "${page}")
