# Installs BUILD_FOLDER, builds the consumer against what was installed, and renders SCENE with it.
function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

set(work ${BUILD_FOLDER}/tests/consumer)
file(REMOVE_RECURSE ${work})
file(MAKE_DIRECTORY ${work})
run(${CMAKE_COMMAND} --install ${BUILD_FOLDER} --prefix ${work}/installed)
# Elsewhere than it was installed: a package must not remember its place.
file(RENAME ${work}/installed ${work}/moved)
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${work}/build -G ${GENERATOR}
    -DCMAKE_CXX_COMPILER=${CXX_COMPILER} -DCMAKE_PREFIX_PATH=${work}/moved)
run(${CMAKE_COMMAND} --build ${work}/build)
run(${work}/build/consumer ${SCENE} ${work}/by_library.exr)
run(${work}/moved/bin/pahrender ${SCENE} -o ${work}/by_program.exr --quiet)
run(${work}/moved/bin/pahrender compare ${work}/by_library.exr ${work}/by_program.exr
    --threshold 0.001)
