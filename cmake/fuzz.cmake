# -DGRID_PATH_PLANNER_FUZZ=ON with clang: everything with libFuzzer's coverage and the address and undefined behaviour
# sanitizers, and test/fuzz as the fuzzer's programs. scripts/fuzz configures such a build.
#
# libFuzzer looks at every counter of its program after each input, so a program holds the functions that its targets may
# call and no others: libraries are static, each function has a section of its own, and sections that nothing
# refers to are left out.
option(GRID_PATH_PLANNER_FUZZ "Build for libFuzzer, with clang" OFF)
if(GRID_PATH_PLANNER_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "GRID_PATH_PLANNER_FUZZ needs -DCMAKE_CXX_COMPILER=clang++, got ${CMAKE_CXX_COMPILER_ID}")
  endif()
  set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O1 -g1")
  set(BUILD_SHARED_LIBS OFF CACHE BOOL "Of the fuzzer's programs, always OFF" FORCE)
  set(sanitizers address,undefined,float-cast-overflow)
  add_compile_options(-fsanitize=fuzzer-no-link,${sanitizers} -fno-sanitize-recover=all -fno-omit-frame-pointer
                      -fsanitize-coverage-ignorelist=${CMAKE_CURRENT_SOURCE_DIR}/test/fuzz/uncounted_functions.txt
                      -ffunction-sections -fdata-sections)
  add_link_options(-fsanitize=${sanitizers} -Wl,--gc-sections -Wl,-z,start-stop-gc)
endif()
