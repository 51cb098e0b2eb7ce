# SPDX-License-Identifier: MIT
# module.cmake - compiles the rooms that play, compose and draw to WebAssembly, for the pages of recordings. Sets
# PAGE_MODULE to the packed module, or to nothing if clang cannot compile it.
option(OCTREEL_PAGE_PLAYS "Let the pages of recordings play and draw: needs clang for WebAssembly" ON)
set(OCTREEL_WASI_SYSROOT /usr CACHE PATH "Prefix of wasi-libc (Debian package wasi-libc)")
find_program(WASM_CLANG NAMES clang)
set(PAGE_MODULE "")
set(wasm_target --target=wasm32-wasi --sysroot=${OCTREEL_WASI_SYSROOT}
    # Every browser with DecompressionStream has the first two. SIMD came with Chrome 91, Firefox 89 and Safari 16.4. It
    # changes no bit of a picture, because its operations round as scalar ones do; relaxed SIMD does not.
    -msign-ext -mnontrapping-fptoint -msimd128)
set(wasm_folder ${CMAKE_CURRENT_BINARY_DIR}/wasm)

# Whether clang finds wasi-libc, lld and its runtime for the target.
function(check_wasm result)
  set(${result} FALSE PARENT_SCOPE)
  if(NOT OCTREEL_PAGE_PLAYS OR NOT WASM_CLANG)
    return()
  endif()
  file(WRITE ${wasm_folder}/check.c "#include <stdlib.h>\nint check(const char *t) { return (int)strtold(t, NULL); }\n")
  execute_process(COMMAND ${WASM_CLANG} ${wasm_target} -mexec-model=reactor -Wl,--export=check -o check.wasm check.c
                  WORKING_DIRECTORY ${wasm_folder} RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(failed EQUAL 0)
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()

# compile_wasm(SOURCE OBJECTS): compiles a source and appends its object to a list.
function(compile_wasm source objects)
  file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${source})
  # Optimize for size, to keep pages small; for speed only the loops over nodes, points, lines and pixels.
  set(optimized -Oz)
  if(name MATCHES "/src/(tree/(leaf|walk)|query/region)[.]c$" OR
     name MATCHES "^viz/([a-z]+/)+(camera|filter|scene|velocity_layer|node_layers|node_boxes|fill|edges|box_lines|quads|paint|stroke|project|splats|splat_buffer|canvas|image|rgba)[.]c$")
    set(optimized -O2 -fno-unroll-loops)
  endif()
  string(REPLACE "/" "_" name ${name})
  set(object ${wasm_folder}/${name}.o)
  add_custom_command(OUTPUT ${object} DEPENDS ${source} DEPFILE ${object}.d VERBATIM
                     COMMAND ${WASM_CLANG} ${wasm_target} ${optimized} -std=c17 -D_POSIX_C_SOURCE=200809L -ffp-contract=off
                             -Wall -Wextra -Wpedantic -Werror=implicit-function-declaration ${wasm_includes} -MD -MF ${object}.d -c ${source} -o ${object})
  set(${objects} ${${objects}} ${object} PARENT_SCOPE)
endfunction()

check_wasm(has_wasm)
if(NOT has_wasm AND OCTREEL_REQUIRE_ORACLES)
  message(FATAL_ERROR "Pages that play need the Debian packages clang, lld, wasi-libc and libclang-rt-dev-wasm32")
elseif(NOT has_wasm)
  message(STATUS "Pages of recordings will show frames but not play; to let them play, install the Debian packages "
                 "clang, lld, wasi-libc and libclang-rt-dev-wasm32")
  return()
endif()

# Copy jansson's headers, since their folder also holds the headers of this machine's own libc.
find_path(JANSSON_HEADER jansson.h HINTS ${JANSSON_INCLUDE_DIRS} REQUIRED)
find_path(JANSSON_CONFIG_HEADER jansson_config.h HINTS ${JANSSON_INCLUDE_DIRS} REQUIRED)
configure_file(${JANSSON_HEADER}/jansson.h ${wasm_folder}/include/jansson.h COPYONLY)
configure_file(${JANSSON_CONFIG_HEADER}/jansson_config.h ${wasm_folder}/include/jansson_config.h COPYONLY)

set(wasm_includes -I${PROJECT_SOURCE_DIR}/lib/include -I${CMAKE_CURRENT_SOURCE_DIR}/include)
foreach(room base image scene layers compose draw clouds formats record replay)
  list(APPEND wasm_includes -I${CMAKE_CURRENT_SOURCE_DIR}/${room})
endforeach()
list(APPEND wasm_includes -isystem ${wasm_folder}/include)

# absent.c replaces the sources that are left out; the linker drops unused functions.
file(GLOB wasm_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/src/*/*.c base/*.c image/image.c scene/*.c layers/*.c
     compose/*.c draw/*.c clouds/point_world.c formats/*.c record/playback.c record/picture.c replay/pick.c replay/node_reason.c page/module/*.c)
list(FILTER wasm_sources EXCLUDE REGEX "/(context[a-z_]*|gl_surface|file_read|parallel)\\.c$")
list(APPEND wasm_sources ${GLYPHS})
set(wasm_objects "")
foreach(source ${wasm_sources})
  compile_wasm(${source} wasm_objects)
endforeach()

file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/page/module/module.c exports REGEX "^[a-z].* \\**web_[a-z_]+\\(")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS page/module/module.c) # the exports are read from it
list(TRANSFORM exports REPLACE "^[^(]*[ *](web_[a-z_]+)\\(.*" "-Wl,--export=\\1")
# Link without -O: with it clang would run an installed wasm-opt, which rejects features that a stripped module does not
# declare.
add_custom_command(OUTPUT ${wasm_folder}/octreel.wasm DEPENDS ${wasm_objects} VERBATIM
                   COMMAND ${WASM_CLANG} ${wasm_target} -mexec-model=reactor ${wasm_objects} -Wl,--gc-sections
                           -Wl,--strip-all,--compress-relocations -Wl,-z,stack-size=1048576 ${exports}
                           -Wl,--export=web_used -o ${wasm_folder}/octreel.wasm)
set(PAGE_MODULE ${wasm_folder}/octreel.wasm.letters)
set(pack ${CMAKE_CURRENT_SOURCE_DIR}/page/module/pack_module)
add_custom_command(OUTPUT ${PAGE_MODULE} DEPENDS ${wasm_folder}/octreel.wasm ${pack} VERBATIM
                   COMMAND sh -c "\"$0\" octreel.wasm >octreel.wasm.letters" ${pack}
                   WORKING_DIRECTORY ${wasm_folder})
