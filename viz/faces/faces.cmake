# SPDX-License-Identifier: MIT
# faces.cmake - the letters of frames: fonts of Spleen, drawn for whole pixels in each of the sizes that pictures need,
# become GLYPHS, a C source of rectangles (draw/glyphs.h). No program that was built reads a font.
find_package(ZLIB REQUIRED)
set(OCTREEL_FONTS "" CACHE PATH "Where spleen-8x16.psfu and its other sizes are, with .gz or without")
set(fonts "")
foreach(size 5x8 6x12 8x16 12x24 16x32) # FACE_MAP of scene/lettering.h
  unset(OCTREEL_FONT_${size} CACHE) # build folders of earlier versions have it
  find_file(OCTREEL_FONT_${size} NAMES spleen-${size}.psfu.gz spleen-${size}.psfu HINTS ${OCTREEL_FONTS}
            PATHS /usr/share/consolefonts /usr/share/kbd/consolefonts NO_CACHE)
  if(NOT OCTREEL_FONT_${size})
    message(FATAL_ERROR "Octreel's letters are made of the fonts of Spleen, and spleen-${size}.psfu.gz is not found: "
                        "install them (Debian: fonts-spleen), or name their folder with -DOCTREEL_FONTS=FOLDER")
  endif()
  list(APPEND fonts ${OCTREEL_FONT_${size}})
endforeach()

add_executable(octreel_faces_convert faces/faces_convert.c)
target_include_directories(octreel_faces_convert PRIVATE draw)
target_link_libraries(octreel_faces_convert PRIVATE ZLIB::ZLIB octreel_rules)
set(GLYPHS ${CMAKE_CURRENT_BINARY_DIR}/glyphs.c)
add_custom_command(OUTPUT ${GLYPHS} DEPENDS ${fonts} COMMAND octreel_faces_convert ${GLYPHS} ${fonts} VERBATIM)
