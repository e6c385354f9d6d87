# The OpenGL 4.5 core loader, generated at configure time by Debian's python3-glad (works offline).
find_program(GLAD_PROGRAM glad REQUIRED PATHS /usr/bin)
set(GLAD_DIR ${CMAKE_BINARY_DIR}/glad)
if(NOT EXISTS ${GLAD_DIR}/src/gl.c)
  execute_process(COMMAND ${GLAD_PROGRAM} --reproducible --api gl:core=4.5 --out-path ${GLAD_DIR} c
                  RESULT_VARIABLE glad_result OUTPUT_QUIET ERROR_VARIABLE glad_error)
  if(NOT glad_result EQUAL 0)
    message(FATAL_ERROR "glad could not generate the OpenGL loader: ${glad_error}")
  endif()
endif()
add_library(glad STATIC ${GLAD_DIR}/src/gl.c)
target_include_directories(glad SYSTEM PUBLIC ${GLAD_DIR}/include)
target_link_libraries(glad PUBLIC ${CMAKE_DL_LIBS})
