# Compiles through ccache if it is found and can write, so that other checkouts of the project reuse
# the results.
find_program(CCACHE_PROGRAM ccache)
if(NOT CCACHE_PROGRAM)
  return()
endif()
execute_process(COMMAND ${CCACHE_PROGRAM} -k cache_dir
  OUTPUT_VARIABLE ccache_folder OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
set(ccache_probe ${ccache_folder}/pahrender.probe)
execute_process(COMMAND ${CMAKE_COMMAND} -E make_directory ${ccache_folder}
  ERROR_QUIET)
execute_process(COMMAND ${CMAKE_COMMAND} -E touch ${ccache_probe}
  RESULT_VARIABLE ccache_failed ERROR_QUIET)
if(ccache_failed)
  message(STATUS "ccache cannot write to ${ccache_folder}: compiling without it")
  return()
endif()
file(REMOVE ${ccache_probe})

# Paths below the project are hashed as relative paths, precompiled headers by their content.
set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env
  CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1
  CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
  ${CCACHE_PROGRAM})
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options(-fpch-preprocess)
elseif(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  add_compile_options("SHELL:-Xclang -fno-pch-timestamp")
endif()
