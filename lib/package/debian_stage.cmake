# SPDX-License-Identifier: MIT
# Run by CPack when every component lies in its folder, as dpkg will install it: adds what a package of Debian holds beside
# that, and finds what it depends on.
cmake_policy(VERSION 3.22)
set(work ${CPACK_TOPLEVEL_DIRECTORY}/debian_stage)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work}/debian)
file(GLOB former ${CPACK_PACKAGE_DIRECTORY}/*.deb) # of an earlier version, say
if(former)
  file(REMOVE ${former})
endif()

# run(COMMAND...): in the folder of work; all its output is in `said`.
function(run)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env LC_ALL=C ${ARGV} WORKING_DIRECTORY ${work} COMMAND_ERROR_IS_FATAL ANY
                  OUTPUT_VARIABLE said OUTPUT_STRIP_TRAILING_WHITESPACE)
  set(said "${said}" PARENT_SCOPE)
endfunction()

# The date of every file, for packages that are the same bytes wherever they are made: that of the last version.
file(READ ${CPACK_OCTREEL_SOURCE}/lib/CHANGELOG.md changes)
if(NOT "${changes}" MATCHES "\n## ${CPACK_PACKAGE_VERSION} \\(([0-9-]+)\\)\n")
  message(FATAL_ERROR "lib/CHANGELOG.md does not say what ${CPACK_PACKAGE_VERSION} is, and of which day")
endif()
if("$ENV{SOURCE_DATE_EPOCH}" STREQUAL "")
  run(date -u -d ${CMAKE_MATCH_1} +%s)
  set(ENV{SOURCE_DATE_EPOCH} ${said})
endif()
run(date -u -d @$ENV{SOURCE_DATE_EPOCH} "+%a, %d %b %Y %H:%M:%S +0000")
file(WRITE ${work}/changelog.Debian
     "octreel (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
     "  * Version ${CPACK_PACKAGE_VERSION}, as made by its own build; changelog.gz says what is new.\n\n"
     " -- ${CPACK_PACKAGE_CONTACT}  ${said}\n")
file(WRITE ${work}/triggers "activate-noawait ldconfig\n")

file(WRITE ${work}/debian/control "Source: octreel\n")
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} key)
  set(package ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  file(APPEND ${work}/debian/control "\nPackage: ${package}\nArchitecture: any\n")
endforeach()

foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} key)
  set(package ${CPACK_DEBIAN_${key}_PACKAGE_NAME})
  set(staged ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component})
  set(documents ${staged}/usr/share/doc/${package})

  # Letters of others are in what draws.
  file(READ ${CPACK_OCTREEL_SOURCE}/lib/LICENSE terms)
  if(component MATCHES octreel)
    file(READ ${CPACK_OCTREEL_SOURCE}/viz/THIRD-PARTY others)
    string(APPEND terms "\n${others}")
  endif()
  file(WRITE ${documents}/copyright "${terms}")
  file(COPY ${work}/changelog.Debian DESTINATION ${documents})
  file(COPY_FILE ${CPACK_OCTREEL_SOURCE}/lib/CHANGELOG.md ${documents}/changelog)
  if(EXISTS ${staged}/usr/share/zsh/site-functions) # where Debian's zsh does not look
    file(RENAME ${staged}/usr/share/zsh/site-functions ${staged}/usr/share/zsh/vendor-completions)
  endif()
  file(GLOB manuals ${staged}/usr/share/man/man*/*)
  run(gzip -9nf ${documents}/changelog.Debian ${documents}/changelog ${manuals})

  # A library tells whoever links it what to depend on, and dpkg to look for it.
  file(GLOB_RECURSE libraries ${staged}/usr/lib/*.so.*.*.*)
  if(libraries)
    set(told ${work}/debian/${package}/DEBIAN)
    file(MAKE_DIRECTORY ${told})
    file(CREATE_LINK ${staged}/usr ${work}/debian/${package}/usr SYMBOLIC)
    run(dpkg-gensymbols -c4 -p${package} -v${CPACK_PACKAGE_VERSION} -e${libraries} -O${told}/symbols
        -I${CPACK_OCTREEL_SOURCE}/lib/package/${component}.symbols)
    file(WRITE ${told}/shlibs "${component} ${CPACK_OCTREEL_SO} ${package} (>= ${CPACK_PACKAGE_VERSION})\n")
    file(COPY ${work}/triggers DESTINATION ${told})
    file(GLOB CPACK_DEBIAN_${key}_PACKAGE_CONTROL_EXTRA ${told}/*)
  endif()
endforeach()

# What the binaries are linked with, by the symbols that they use.
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} key)
  set(staged ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/${component})
  file(GLOB_RECURSE binaries ${staged}/usr/bin/* ${staged}/usr/lib/*.so.*.*.*)
  if(binaries)
    run(strip --strip-unneeded --remove-section=.comment --remove-section=.note ${binaries})
    run(dpkg-shlibdeps -O ${binaries})
    string(REGEX REPLACE ".*Depends=" "" linked "${said}")
    set(depends ${linked} ${CPACK_DEBIAN_${key}_PACKAGE_DEPENDS})
    list(JOIN depends ", " CPACK_DEBIAN_${key}_PACKAGE_DEPENDS)
  endif()
endforeach()
run(chmod -R u=rwX,go=rX ${CPACK_TEMPORARY_INSTALL_DIRECTORY}) # whatever the umask is
