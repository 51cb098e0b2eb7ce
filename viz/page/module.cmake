# SPDX-License-Identifier: MIT
# module.cmake - the page's module: the rooms that play, make scenes and draw, compiled to WebAssembly from the same
# sources. Sets PAGE_MODULE to the file that the page takes in, or to nothing where clang cannot compile it.
option(OCTREEL_PAGE_PLAYS "Put the program into the pages of recordings, where clang compiles to WebAssembly" ON)
set(OCTREEL_WASI_SYSROOT /usr CACHE PATH "Where wasi-libc is: Debian's package wasi-libc")
find_program(WASM_CLANG NAMES clang)
set(PAGE_MODULE "")
set(wasm_target --target=wasm32-wasi --sysroot=${OCTREEL_WASI_SYSROOT}
    -msign-ext -mnontrapping-fptoint) # older than DecompressionStream, which pages use
set(wasm_folder ${CMAKE_CURRENT_BINARY_DIR}/wasm)

# Whether clang has all it takes: wasi-libc, lld, and its own runtime for the target.
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

# compile_wasm(SOURCE OBJECTS): adds the object of a source to a list.
function(compile_wasm source objects)
  file(RELATIVE_PATH name ${PROJECT_SOURCE_DIR} ${source})
  # A page is to be small: fast is what is done for each node, point, line and pixel.
  set(optimized -Oz)
  if(name MATCHES "/src/(tree/(leaf|tree|walk)|query/(region|search)|game/(game|bodies))[.]c$" OR
     name MATCHES "/(camera|filter|node_layers|node_boxes|fill|edges|box_lines|quads|stroke|project|splats|canvas)[.]c$")
    set(optimized -O2 -fno-unroll-loops)
  endif()
  string(REPLACE "/" "_" name ${name})
  set(object ${wasm_folder}/${name}.o)
  add_custom_command(OUTPUT ${object} DEPENDS ${source} DEPFILE ${object}.d VERBATIM
                     COMMAND ${WASM_CLANG} ${wasm_target} ${optimized} -std=c17 -D_POSIX_C_SOURCE=200809L -ffp-contract=off
                             -Wall -Wextra -Wpedantic ${wasm_includes} -MD -MF ${object}.d -c ${source} -o ${object})
  set(${objects} ${${objects}} ${object} PARENT_SCOPE)
endfunction()

check_wasm(has_wasm)
if(NOT has_wasm AND OCTREEL_REQUIRE_ORACLES)
  message(FATAL_ERROR "The pages that play need clang, lld, wasi-libc and libclang-rt-dev-wasm32 (their Debian names)")
elseif(NOT has_wasm)
  message(STATUS "Pages of recordings will not play: clang, lld, wasi-libc and clang's runtime for wasm32 are needed "
                 "(Debian: clang lld wasi-libc libclang-rt-dev-wasm32)")
  return()
endif()

# Headers of libraries, without those of this machine's own system that lie beside them.
find_path(JANSSON_HEADER jansson.h HINTS ${JANSSON_INCLUDE_DIRS} REQUIRED)
find_path(JANSSON_CONFIG_HEADER jansson_config.h HINTS ${JANSSON_INCLUDE_DIRS} REQUIRED)
configure_file(${JANSSON_HEADER}/jansson.h ${wasm_folder}/include/jansson.h COPYONLY)
configure_file(${JANSSON_CONFIG_HEADER}/jansson_config.h ${wasm_folder}/include/jansson_config.h COPYONLY)

set(wasm_includes -I${PROJECT_SOURCE_DIR}/lib/include -I${CMAKE_CURRENT_SOURCE_DIR}/include)
foreach(room exact tree query audit game)
  list(APPEND wasm_includes -I${PROJECT_SOURCE_DIR}/lib/src/${room})
endforeach()
foreach(room base image scene layers compose draw clouds formats record replay)
  list(APPEND wasm_includes -I${CMAKE_CURRENT_SOURCE_DIR}/${room})
endforeach()
list(APPEND wasm_includes -isystem ${wasm_folder}/include)

# absent.c stands for what a page does not have; of the rest the linker takes what is used.
file(GLOB wasm_sources CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/src/*/*.c base/*.c image/image.c scene/*.c layers/*.c
     compose/*.c draw/*.c clouds/point_world.c formats/*.c record/playback.c record/picture.c replay/pick.c page/module/*.c)
list(FILTER wasm_sources EXCLUDE REGEX "/(context[a-z_]*|gl_surface|file_read|parallel)\\.c$")
list(APPEND wasm_sources ${GLYPHS})
set(wasm_objects "")
foreach(source ${wasm_sources})
  compile_wasm(${source} wasm_objects)
endforeach()

file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/page/module/module.c exports REGEX "^[a-z].* \\**web_[a-z_]+\\(")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS page/module/module.c) # for its exports
list(TRANSFORM exports REPLACE "^[^(]*[ *](web_[a-z_]+)\\(.*" "-Wl,--export=\\1")
# Without -O, which would have clang run wasm-opt where that is installed: it refuses what the stripped module does not
# say it uses.
add_custom_command(OUTPUT ${wasm_folder}/octreel.wasm DEPENDS ${wasm_objects} VERBATIM
                   COMMAND ${WASM_CLANG} ${wasm_target} -mexec-model=reactor ${wasm_objects} -Wl,--gc-sections
                           -Wl,--strip-all,--compress-relocations -Wl,-z,stack-size=1048576 ${exports}
                           -Wl,--export=web_used -o ${wasm_folder}/octreel.wasm)
set(PAGE_MODULE ${wasm_folder}/octreel.wasm.letters)
set(pack ${CMAKE_CURRENT_SOURCE_DIR}/page/module/pack_module)
add_custom_command(OUTPUT ${PAGE_MODULE} DEPENDS ${wasm_folder}/octreel.wasm ${pack} VERBATIM
                   COMMAND sh -c "\"$0\" octreel.wasm >octreel.wasm.letters" ${pack}
                   WORKING_DIRECTORY ${wasm_folder})
