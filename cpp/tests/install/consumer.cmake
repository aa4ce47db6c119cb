# Installs handey into an empty prefix and uses it from outside, in each of the ways a C++ project takes a library in:
# the examples by find_package with the static library, one with the shared one, one by pkg-config; and the source tree as
# a subdirectory of another project (configured only: compiling it once more would prove nothing new).
# Run with cmake -P; variables: BUILD_DIR SOURCE_DIR SCRATCH_DIR GENERATOR COMPILER LAUNCHER FLAGS.
cmake_minimum_required(VERSION 3.25)

set(prefix ${SCRATCH_DIR}/prefix)
set(models ${SOURCE_DIR}/models)
file(REMOVE_RECURSE ${SCRATCH_DIR})
file(MAKE_DIRECTORY ${SCRATCH_DIR})

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${status}): ${command}\n${output}")
  endif()
endfunction()

set(configure ${CMAKE_COMMAND} -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER}
  -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER} -D CMAKE_CXX_FLAGS=${FLAGS}
  -D CMAKE_PREFIX_PATH=${prefix} -D HANDEY_MODELS_DIR=${models})

run(${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${prefix} --component development)

message(STATUS "examples, static library")
run(${configure} -S ${SOURCE_DIR}/cpp/examples -B ${SCRATCH_DIR}/static)
run(${CMAKE_COMMAND} --build ${SCRATCH_DIR}/static)
run(${CMAKE_CTEST_COMMAND} --test-dir ${SCRATCH_DIR}/static --output-on-failure --no-tests=error)

message(STATUS "one example, shared library")
run(${configure} -S ${SOURCE_DIR}/cpp/examples -B ${SCRATCH_DIR}/shared -D BUILD_SHARED_LIBS=ON)
run(${CMAKE_COMMAND} --build ${SCRATCH_DIR}/shared --target 01_forward_inverse_kinematics)
run(${SCRATCH_DIR}/shared/01_forward_inverse_kinematics ${models})

message(STATUS "one example, pkg-config")
find_program(PKG_CONFIG pkg-config)
if(PKG_CONFIG)
  file(GLOB package_file ${prefix}/lib*/pkgconfig/handey.pc ${prefix}/lib/*/pkgconfig/handey.pc)
  get_filename_component(package_dir ${package_file} DIRECTORY)
  set(ENV{PKG_CONFIG_PATH} ${package_dir}:$ENV{PKG_CONFIG_PATH})
  execute_process(COMMAND ${PKG_CONFIG} --cflags --libs handey OUTPUT_VARIABLE flags
    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
  if(flags MATCHES "-std=|fcl|ompl")
    message(FATAL_ERROR "handey.pc hands on more than Eigen: ${flags}")
  endif()
  separate_arguments(flags UNIX_COMMAND "${flags}")
  separate_arguments(build_flags UNIX_COMMAND "${FLAGS}")
  get_filename_component(library_dir ${package_dir} DIRECTORY)
  run(${COMPILER} ${build_flags} -std=c++17
    ${SOURCE_DIR}/cpp/examples/01_forward_inverse_kinematics.cpp
    -o ${SCRATCH_DIR}/by_pkg_config ${flags} -Wl,-rpath,${library_dir})
  run(${SCRATCH_DIR}/by_pkg_config ${models})
else()
  message(STATUS "no pkg-config here: left out")
endif()

message(STATUS "subdirectory of another project")
file(MAKE_DIRECTORY ${SCRATCH_DIR}/outer)
file(WRITE ${SCRATCH_DIR}/outer/CMakeLists.txt "
cmake_minimum_required(VERSION 3.25)
project(outer LANGUAGES CXX)
add_subdirectory(${SOURCE_DIR} handey)
add_executable(use ${SOURCE_DIR}/cpp/examples/01_forward_inverse_kinematics.cpp)
target_link_libraries(use PRIVATE handey::handey)
if(TARGET timing_test OR NOT CMAKE_BUILD_TYPE STREQUAL \"\")
  message(FATAL_ERROR \"handey changed the project that contains it\")
endif()
")
run(${configure} -S ${SCRATCH_DIR}/outer -B ${SCRATCH_DIR}/outer/build)
message(STATUS "all of them work")
