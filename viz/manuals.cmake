# SPDX-License-Identifier: MIT
# manuals.cmake - the manuals and the shells' completions, as the program that was just built writes them from the tables
# that it reads its command line by. In a cross build CMAKE_CROSSCOMPILING_EMULATOR runs it.
set(OCTREEL_WRITER "" CACHE FILEPATH "An octreel of this version that writes manuals and completions, where the one that \
is built cannot run here: of a cross build without an emulator")
set(writer octreel)
if(OCTREEL_WRITER)
  set(writer ${OCTREEL_WRITER})
elseif(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  message(STATUS "Manuals and completions are left out, for octreel cannot run here; -D OCTREEL_WRITER=FILE names one "
                 "of the same version that can")
  return()
endif()

# add_written(FILE FOLDER ARGUMENT...): what octreel prints, installed in a folder.
set(written "")
file(MAKE_DIRECTORY ${CMAKE_CURRENT_BINARY_DIR}/written)
function(add_written file folder)
  set(file ${CMAKE_CURRENT_BINARY_DIR}/written/${file})
  add_custom_command(OUTPUT ${file} DEPENDS octreel COMMAND ${writer} ${ARGN} > ${file} VERBATIM)
  install(FILES ${file} DESTINATION ${folder})
  set(written ${written} ${file} PARENT_SCOPE)
endfunction()

add_written(octreel.1 ${CMAKE_INSTALL_MANDIR}/man1 help --man octreel)
foreach(source ${cli_sources})
  if(source MATCHES "/cmd_([a-z]+)\\.c$")
    add_written(octreel-${CMAKE_MATCH_1}.1 ${CMAKE_INSTALL_MANDIR}/man1 help --man ${CMAKE_MATCH_1})
  endif()
endforeach()
foreach(text ${texts})
  add_written(octreel-${text}.5 ${CMAKE_INSTALL_MANDIR}/man5 help --man ${text})
endforeach()

add_written(octreel ${CMAKE_INSTALL_DATADIR}/bash-completion/completions help --complete bash)
add_written(_octreel ${CMAKE_INSTALL_DATADIR}/zsh/site-functions help --complete zsh)
add_written(octreel.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d help --complete fish)

add_custom_target(octreel_written ALL DEPENDS ${written})
add_dependencies(octreel_installed octreel_written)
