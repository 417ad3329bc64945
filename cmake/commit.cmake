# cmake -DSOURCE=... -DOUT=... -P commit.cmake: writes the commit of the sources into OUT, which keeps its time where
# nothing changes. "unknown" where SOURCE is not the root of a git repository (an archive, also one within a repository).
set(commit unknown)
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --verify --quiet HEAD OUTPUT_VARIABLE head
                  RESULT_VARIABLE failed OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT failed)
    execute_process(COMMAND ${GIT} --no-optional-locks -C ${SOURCE} status --porcelain --untracked-files=no
                    OUTPUT_VARIABLE changes ERROR_QUIET)
    set(commit ${head})
    if(changes)
      string(APPEND commit +changes)
    endif()
  endif()
endif()
set(known "")
if(EXISTS ${OUT})
  file(READ ${OUT} known)
endif()
if(NOT known STREQUAL "${commit}\n")
  file(WRITE ${OUT} "${commit}\n")
endif()
