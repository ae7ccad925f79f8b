# cmake -DSOURCE=... -DOUTPUT=... -DVERSION=... -DCOMPILER=... -DFLAGS=... -DCXX=... -P build_info.cmake
# Writes build_info.h; configure_file leaves the file alone if nothing changed, so that nothing is recompiled.
set(COMMIT unknown)
set(DIRTY false)
set(CHANGES "")
execute_process(COMMAND git rev-parse HEAD WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE failed OUTPUT_VARIABLE head
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT failed)
  set(COMMIT ${head})
  execute_process(COMMAND git status --porcelain --untracked-files=no WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    set(DIRTY true)
    execute_process(COMMAND git diff HEAD COMMAND git hash-object --stdin WORKING_DIRECTORY ${SOURCE}
                    OUTPUT_VARIABLE CHANGES OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
endif()
# What the compiler hands on: -march=znver3 from GNU, "-target-cpu" "znver3" from Clang.
set(MARCH unknown)
string(REGEX MATCH "-march=[^ ]+" march "${FLAGS}")
execute_process(COMMAND ${CXX} ${march} "-###" -E -x c++ /dev/null OUTPUT_QUIET ERROR_VARIABLE handed_on)
string(REGEX REPLACE "-march=native" "" handed_on "${handed_on}")
if(handed_on MATCHES "(-march=|\"-target-cpu\" \")([a-z0-9._-]+)")
  set(MARCH ${CMAKE_MATCH_2})
endif()
# A compiler older than the processor names the last one that it knows, and adds what is beyond that.
if(handed_on MATCHES "(-m|\"\\+)avx512f")
  string(APPEND MARCH "+avx512f")
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/build_info.h.in ${OUTPUT} @ONLY)
