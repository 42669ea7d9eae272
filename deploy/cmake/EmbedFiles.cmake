# SPDX-License-Identifier: Apache-2.0
# embed_files(TARGET SYMBOL BASE file...): compiles files into TARGET as the table
# `raybundle::SYMBOL` (span of EmbeddedFile, names relative to BASE), see server/gpu/embedded_file.h.
function(embed_files target symbol base)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp)
    set(inputs "")
    foreach(file ${ARGN})
        list(APPEND inputs ${base}/${file})
    endforeach()
    list(JOIN ARGN "|" names)
    add_custom_command(
        OUTPUT ${output}
        COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DSYMBOL=${symbol} -DBASE=${base} -DNAMES=${names}
                -P ${CMAKE_SOURCE_DIR}/deploy/cmake/WriteEmbedded.cmake
        DEPENDS ${inputs} ${CMAKE_SOURCE_DIR}/deploy/cmake/WriteEmbedded.cmake
        COMMENT "Embedding ${symbol}"
        VERBATIM)
    set_source_files_properties(${output} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    target_sources(${target} PRIVATE ${output})
endfunction()
