# Embeds every .glsl file into the binary as a (path, text) table, so that the program runs from anywhere.
# RELIGHT_SHADER_DIR=<source tree> at run time reads the files from disk instead (shader development).
function(relight_embed_shaders target)
  file(GLOB_RECURSE shader_files CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}
       ${CMAKE_SOURCE_DIR}/common/*.glsl ${CMAKE_SOURCE_DIR}/methods/*.glsl)
  set(out ${CMAKE_BINARY_DIR}/generated/embedded_shaders.cpp)
  set(inputs "")
  foreach(f ${shader_files})
    list(APPEND inputs ${CMAKE_SOURCE_DIR}/${f})
  endforeach()
  add_custom_command(OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DROOT=${CMAKE_SOURCE_DIR} "-DFILES=${shader_files}"
            -P ${CMAKE_SOURCE_DIR}/cmake/WriteEmbeddedShaders.cmake
    DEPENDS ${inputs} ${CMAKE_SOURCE_DIR}/cmake/WriteEmbeddedShaders.cmake VERBATIM)
  target_sources(${target} PRIVATE ${out})
endfunction()
