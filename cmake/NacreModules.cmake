# The modules of lib/ in five storeys, lowest first: a module may include only modules that stand before it.
set(NACRE_GROUND base thesis pattern material optimize)
set(NACRE_PHYSICS fem tester gpu crack film animation)
set(NACRE_KNOWLEDGE measurement surrogate sysid diagnosis)
set(NACRE_GAME explore select families fabricate game)
set(NACRE_WORLD wire store offline runtime client run report laboratory dashboard)
set(NACRE_MODULES ${NACRE_GROUND} ${NACRE_PHYSICS} ${NACRE_KNOWLEDGE} ${NACRE_GAME} ${NACRE_WORLD})

set(NACRE_INCLUDE_FOLDER include/nacre) # below PREFIX, of the public headers

add_library(nacre_flags INTERFACE)
# -ffp-contract=off: the agents' decisions are the same under every compiler; the simulation kernel fuses explicitly.
target_compile_options(nacre_flags INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor -ffp-contract=off)
if(CMAKE_UNITY_BUILD) # sources are included there, so that GCC takes what stays inside one for a header's
  target_compile_options(nacre_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()

# Makes a static library fit for the Python module, which is a shared one. Without interposition the code stays as it is
# in a program: same speed, same bits.
function(nacre_for_python target)
  if(NACRE_PYTHON)
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    target_compile_options(${target} PRIVATE -fno-semantic-interposition)
  endif()
endfunction()

# nacre_module(NAME DEPENDS other modules... LIBRARIES external targets...)
# Builds every .cpp of lib/NAME and lib/NAME/rivals into the static library nacre::NAME; the include root is lib/.
function(nacre_module name)
  cmake_parse_arguments(ARG "" "" "DEPENDS;LIBRARIES" ${ARGN})
  list(FIND NACRE_MODULES ${name} own_rank)
  foreach(dependency ${ARG_DEPENDS})
    list(FIND NACRE_MODULES ${dependency} rank)
    if(rank LESS 0 OR NOT rank LESS own_rank)
      message(FATAL_ERROR "module ${name} may not depend on ${dependency}: it does not stand before it in NACRE_MODULES")
    endif()
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp ${CMAKE_CURRENT_SOURCE_DIR}/rivals/*.cpp)
  if(sources)
    add_library(nacre_${name} STATIC ${sources})
    set(scope PUBLIC)
    target_link_libraries(nacre_${name} PRIVATE $<BUILD_INTERFACE:nacre_flags>)
    nacre_for_python(nacre_${name})
  else()
    add_library(nacre_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  target_include_directories(nacre_${name} ${scope} $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/lib>
                                                    $<INSTALL_INTERFACE:${NACRE_INCLUDE_FOLDER}>)
  set_target_properties(nacre_${name} PROPERTIES EXPORT_NAME ${name})
  list(TRANSFORM ARG_DEPENDS PREPEND nacre::)
  target_link_libraries(nacre_${name} ${scope} ${ARG_DEPENDS} ${ARG_LIBRARIES})
  add_library(nacre::${name} ALIAS nacre_${name})
endfunction()

# The suite of a test SUITE.NAME and how many seconds it may take, NACRE_PATIENCE times as many in instrumented builds.
function(nacre_test_in_suite suite name seconds)
  math(EXPR limit "${seconds} * ${NACRE_PATIENCE}")
  set_tests_properties(${suite}.${name} PROPERTIES LABELS ${suite} TIMEOUT ${limit})
endfunction()

# nacre_test(NAME SOURCES ... LIBRARIES ... [LABEL unit|physics|...] [TIMEOUT seconds])
# A GoogleTest program registered with CTest as one test named LABEL.NAME.
function(nacre_test name)
  cmake_parse_arguments(ARG "" "LABEL;TIMEOUT" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT ARG_LABEL)
    set(ARG_LABEL unit)
  endif()
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 1200)  # of a hung run: slow cores need half of it
  endif()
  set(target ${ARG_LABEL}_${name}_test)
  add_executable(${target} ${ARG_SOURCES})
  target_link_libraries(${target} PRIVATE nacre_flags ${ARG_LIBRARIES} GTest::gtest GTest::gmock GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE NACRE_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
                                               NACRE_BINARY_DIR="${CMAKE_RUNTIME_OUTPUT_DIRECTORY}")
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  add_test(NAME ${ARG_LABEL}.${name} COMMAND ${target})
  nacre_test_in_suite(${ARG_LABEL} ${name} ${ARG_TIMEOUT})
endfunction()
