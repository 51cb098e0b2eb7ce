# SPDX-License-Identifier: MIT
# Debian packages, in BUILD/packages: cmake --build BUILD --target package. They are made from a build of their own, with
# shared libraries and the prefix /usr, whatever BUILD itself is.
set(OCTREEL_MAINTAINER "The Octreel authors <octreel@users.noreply.github.com>"
    CACHE STRING "Who answers for the packages: NAME <ADDRESS>")
set(debian_build ${PROJECT_BINARY_DIR}/packages)
if(NOT OCTREEL_DEBIAN)
  cmake_host_system_information(RESULT cores QUERY NUMBER_OF_LOGICAL_CORES)
  add_custom_target(package USES_TERMINAL VERBATIM
                    COMMAND ${CMAKE_COMMAND} -S ${PROJECT_SOURCE_DIR} -B ${debian_build} -G ${CMAKE_GENERATOR}
                            -D OCTREEL_DEBIAN=ON -D CMAKE_C_COMPILER=${CMAKE_C_COMPILER} -D CMAKE_BUILD_TYPE=Release
                            -D BUILD_SHARED_LIBS=ON -D BUILD_TESTING=OFF -D CMAKE_INSTALL_PREFIX=/usr
                            -D OCTREEL_MAINTAINER=${OCTREEL_MAINTAINER}
                            -D CMAKE_SKIP_INSTALL_RPATH=ON -D CMAKE_BUILD_RPATH_USE_ORIGIN=ON
                    COMMAND ${CMAKE_COMMAND} --build ${debian_build} --parallel ${cores} --target package)
  return()
endif()

# Nothing is built if a program is missing that debian_stage.cmake runs after the build.
set(missing "")
foreach(program dpkg-gensymbols dpkg-shlibdeps strip gzip)
  find_program(OCTREEL_${program} ${program})
  if(NOT OCTREEL_${program})
    list(APPEND missing ${program})
  endif()
endforeach()
if(missing)
  list(JOIN missing ", " missing)
  message(FATAL_ERROR "Packages need ${missing}. Install them: sudo apt-get install dpkg-dev binutils gzip")
endif()

# Made for one release: 0.1.0-1~deb12 is older than 0.1.0-1~deb13, and both are older than 0.1.0-1, which is sid's.
file(STRINGS /etc/os-release system REGEX "^(ID|VERSION_ID)=")
set(release 1)
if("${system}" MATCHES "VERSION_ID=\"?([0-9.]+)")
  set(release_number ${CMAKE_MATCH_1})
  string(REGEX MATCH "(^|;)ID=\"?([a-z]+)" ignored "${system}")
  string(REPLACE debian deb release "1~${CMAKE_MATCH_2}${release_number}")
endif()


# add_package(COMPONENT NAME SECTION DESCRIPTION DEPENDS): of a component. What its binaries are linked with comes to it.
macro(add_package component name section description depends)
  string(TOUPPER ${component} key)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section})
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${description}")
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}")
endmacro()

set(so ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(same "(= ${PROJECT_VERSION}-${release})")
# Opened at run time: OSMesa, or EGL with Mesa's drivers.
set(renderer "libosmesa6 | libegl1, libosmesa6 | libgl1-mesa-dri")
set(CPACK_COMPONENTS_ALL "")
add_package(liboctree liboctree${so} libs "point octree with exact answers - shared library
A dynamic point octree in double precision: boxes, balls, sweeps and nearest
neighbours are decided by the real numbers, and the nodes follow from the
contents. With it comes a small game that is played in the tree." "")
add_package(liboctree-dev liboctree-dev libdevel "point octree with exact answers - development files
Headers, pkg-config file and CMake package of liboctree, a dynamic point octree
in double precision." "liboctree${so} ${same}")
add_package(liboctreel liboctreel${so} libs "films an octree in your program - shared library
Records what a program does with an octree, or with a spatial index of its own:
a PNG frame a tick, drawn off-screen by a worker, and the ticks beside them." "${renderer}")
add_package(liboctreel-dev liboctreel-dev libdevel "films an octree in your program - development files
Headers, pkg-config file and CMake package of liboctreel, which records what a
program does with an octree or with a spatial index of its own."
            "liboctreel${so} ${same}, liboctree-dev ${same}")
add_package(liboctreel-compare liboctreel-compare${so} libs "compares pictures in tests - shared library
Compares pixels or PNG files with reference pictures or with baselines of
digests, under a tolerance, and says how they differ." "")
add_package(liboctreel-compare-dev liboctreel-compare-dev libdevel "compares pictures in tests - development files
Header, pkg-config file and CMake package of liboctreel-compare, which compares
pictures in tests. octreel_add_image_test() of the CMake package adds a test of
a program that writes pictures." "liboctreel-compare${so} ${same}, octreel ${same}, libpng-dev")
add_package(octreel octreel devel "films an octree and compares frames
Records a game in an octree as PNG frames, one a tick, without a display; plays
it again, says what is drawn at a pixel, and shows how a cloud of points is
divided. It compares pictures exactly and says why two recordings differ, for
tests of graphics; and it judges the answers of other spatial indexes." "${renderer}")
set(CPACK_DEBIAN_OCTREEL_PACKAGE_SUGGESTS ffmpeg) # frames become a film

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR Octreel)
set(CPACK_PACKAGE_NAME octreel)
set(CPACK_PACKAGE_CONTACT "${OCTREEL_MAINTAINER}")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SOURCE octreel)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${release})
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/debian_stage.cmake)
set(CPACK_OCTREEL_SOURCE ${PROJECT_SOURCE_DIR})
set(CPACK_OCTREEL_SO ${so})
include(CPack)
