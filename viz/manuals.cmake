# SPDX-License-Identifier: MIT
# manuals.cmake - runs the octreel that was just built to write its manuals and shell completions, and installs them. A
# cross build runs octreel with CMAKE_CROSSCOMPILING_EMULATOR, or another octreel, which OCTREEL_WRITER names.
set(OCTREEL_WRITER "" CACHE FILEPATH "For cross builds without an emulator: an octreel of the same version that runs on \
this machine; it writes the manuals and completions")
set(writer octreel)
if(OCTREEL_WRITER)
  set(writer ${OCTREEL_WRITER})
elseif(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  message(STATUS "Manuals and completions are left out: the octreel of this cross build cannot run here. Set "
                 "OCTREEL_WRITER to an octreel of the same version that can")
  return()
endif()

# add_written(FILE FOLDER ARGUMENT...): write the output of octreel ARGUMENT... to FILE, and install it in FOLDER.
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
