# SPDX-License-Identifier: MIT
# What makes a library of ours a package for others: its public names alone, and the rules of cmake --install for its
# headers, its pkg-config file and its CMake package. Nothing that is installed knows where it was built, so that an
# installed tree may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# show_only(TARGET PREFIX): a program that links the library may have functions with any names but PREFIX*. A shared
# library exports no others; the members of an archive become one, in which the others are local.
function(show_only target prefix)
  get_target_property(type ${target} TYPE)
  if(NOT CMAKE_EXECUTABLE_FORMAT STREQUAL ELF)
    return()
  endif()
  if(type STREQUAL SHARED_LIBRARY)
    set(map ${CMAKE_CURRENT_BINARY_DIR}/${target}.map)
    file(CONFIGURE OUTPUT ${map} CONTENT "{ global: ${prefix}*; local: *; };\n")
    target_link_options(${target} PRIVATE LINKER:--version-script=${map})
    set_target_properties(${target} PROPERTIES LINK_DEPENDS ${map} SHOWN_ONLY ${prefix})
    return()
  endif()
  # The sanitizers and link-time optimisation keep notes about symbols, which this would belie.
  string(FIND "${CMAKE_C_FLAGS} ${CMAKE_C_FLAGS_RELEASE}" -flto flto)
  if(OCTREEL_SANITIZE OR OCTREEL_FUZZ OR CMAKE_INTERPROCEDURAL_OPTIMIZATION OR NOT flto EQUAL -1 OR NOT CMAKE_OBJCOPY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES SHOWN_ONLY ${prefix})
  set(whole ${CMAKE_CURRENT_BINARY_DIR}/${target}.whole.o)
  add_custom_command(TARGET ${target} POST_BUILD VERBATIM
                     COMMAND ${CMAKE_LINKER} -r --whole-archive $<TARGET_FILE:${target}> -o ${whole}
                     COMMAND ${CMAKE_OBJCOPY} --wildcard --keep-global-symbol=${prefix}* ${whole}
                     COMMAND ${CMAKE_COMMAND} -E rm $<TARGET_FILE:${target}>
                     COMMAND ${CMAKE_AR} qcs $<TARGET_FILE:${target}> ${whole}
                     COMMAND ${CMAKE_COMMAND} -E rm ${whole})
endfunction()

# install_package(TARGET NAME [HEADERS PATTERN...] [REQUIRES MODULE...] [LIBS FLAG...]): the library, the headers of
# include/ that match a pattern (default: all), and what NAME.pc.in and NAME-config.cmake.in become; REQUIRES and LIBS are
# for pkg-config, of what the library uses itself.
function(install_package target name)
  cmake_parse_arguments(USES "" "" "HEADERS;REQUIRES;LIBS" ${ARGN})
  if(NOT USES_HEADERS)
    set(USES_HEADERS "*.h")
  endif()
  list(TRANSFORM USES_HEADERS PREPEND "PATTERN;")
  list(JOIN USES_REQUIRES " " REQUIRES)
  list(JOIN USES_LIBS " " LIBS)
  get_target_property(type ${target} TYPE)
  set(ARCHIVE TRUE) # and then what it uses is needed by whoever links it, --static or not
  if(type STREQUAL SHARED_LIBRARY)
    set(ARCHIVE FALSE)
    set(REQUIRES "")
    set(LIBS "")
  endif()
  set(pkgconfig_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  set(cmake_folder ${CMAKE_INSTALL_LIBDIR}/cmake/${name})
  set(TO_PREFIX ${CMAKE_INSTALL_PREFIX})
  set(TO_INCLUDE ${CMAKE_INSTALL_FULL_INCLUDEDIR})
  set(TO_BIN ${CMAKE_INSTALL_FULL_BINDIR})
  cmake_path(RELATIVE_PATH TO_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig)
  cmake_path(RELATIVE_PATH TO_INCLUDE BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig)
  cmake_path(RELATIVE_PATH TO_BIN BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/cmake/${name})
  configure_file(${name}.pc.in ${name}.pc @ONLY)
  configure_file(${name}-config.cmake.in ${name}-config.cmake @ONLY)
  write_basic_package_version_file(${name}-config-version.cmake COMPATIBILITY SameMinorVersion)

  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} INSTALL_RPATH "\$ORIGIN"
                                             SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  # The component lib${name} runs programs, and lib${name}-dev builds them; documents are read.
  set(dev COMPONENT lib${name}-dev)
  install(TARGETS ${target} EXPORT ${name}-targets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
          LIBRARY COMPONENT lib${name} NAMELINK_COMPONENT lib${name}-dev ARCHIVE ${dev} RUNTIME COMPONENT lib${name})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} ${dev} FILES_MATCHING ${USES_HEADERS})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.pc DESTINATION ${pkgconfig_folder} ${dev})
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/${name}-config-version.cmake
          DESTINATION ${cmake_folder} ${dev})
  install(EXPORT ${name}-targets NAMESPACE ${name}:: DESTINATION ${cmake_folder} ${dev})
  install(FILES ${PROJECT_SOURCE_DIR}/lib/LICENSE ${PROJECT_SOURCE_DIR}/lib/CHANGELOG.md
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT documents)
endfunction()
