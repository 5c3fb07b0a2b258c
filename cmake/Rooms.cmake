# A room is a folder with one library: every source in it belongs to it. Sources named *_kernel.cpp are
# compiled once per instruction set, joined into one object and localised, so that nothing but the
# functions of that instruction set's namespace leaves it and the linker can never pick an AVX-512
# copy of an inline function for everybody.

# The other sources are compiled several at once where CMAKE_UNITY_BUILD says so (every preset but dev): most of
# what a source costs is the headers that it shares with its neighbours. So what is local to a source
# needs a name that no other source of its room has. clang-tidy still reads each by itself.

set(PENUMBRA_ISAS avx2 avx512)
set(PENUMBRA_ISA_OPTIONS_avx2 -mavx2 -mfma -mf16c -mbmi -mbmi2 -mlzcnt -mpopcnt)
set(PENUMBRA_ISA_OPTIONS_avx512 ${PENUMBRA_ISA_OPTIONS_avx2} -mavx512f -mavx512cd -mavx512dq -mavx512bw -mavx512vl)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # g++'s own AVX-512 headers trip these two.
    list(APPEND PENUMBRA_ISA_OPTIONS_avx512 -Wno-uninitialized -Wno-maybe-uninitialized)
    # g++ gives statics of inline functions a binding that objcopy cannot make local.
    list(APPEND PENUMBRA_ISA_OPTIONS_avx2 -fno-gnu-unique)
    list(APPEND PENUMBRA_ISA_OPTIONS_avx512 -fno-gnu-unique)
endif()

# penumbra_add_kernels(TARGET SOURCE...): adds the kernels' joined objects to TARGET.
function(penumbra_add_kernels target)
    foreach(isa IN LISTS PENUMBRA_ISAS)
        set(objects ${target}_kernels_${isa})
        add_library(${objects} OBJECT ${ARGN})
        set_target_properties(${objects} PROPERTIES UNITY_BUILD OFF)
        target_compile_definitions(${objects} PRIVATE PENUMBRA_ISA=${isa})
        target_compile_options(${objects} PRIVATE ${PENUMBRA_ISA_OPTIONS_${isa}})
        target_link_libraries(${objects} PRIVATE penumbra::options)
        set(joined ${CMAKE_CURRENT_BINARY_DIR}/${target}_${isa}.o)
        string(LENGTH ${isa} length)
        add_custom_command(
            OUTPUT ${joined}
            COMMAND ${CMAKE_LINKER} -r --force-group-allocation -o ${joined} $<TARGET_OBJECTS:${objects}>
            COMMAND ${CMAKE_OBJCOPY} --wildcard
                    --keep-global-symbol=_ZN8penumbra${length}${isa}* ${joined}
            DEPENDS ${objects} $<TARGET_OBJECTS:${objects}>
            COMMAND_EXPAND_LISTS VERBATIM
            COMMENT "Joining the ${isa} kernels of ${target}")
        set_source_files_properties(${joined} PROPERTIES EXTERNAL_OBJECT TRUE GENERATED TRUE)
        target_sources(${target} PRIVATE ${joined})
        set_property(GLOBAL APPEND PROPERTY PENUMBRA_KERNEL_OBJECTS ${joined})
    endforeach()
endfunction()

# penumbra_add_room(NAME [DEPENDS TARGET...] [PRIVATE_DEPENDS TARGET...]): the library penumbra::NAME
# of the folder this is called from. DEPENDS become visible to users of the library.
function(penumbra_add_room name)
    cmake_parse_arguments(PARSE_ARGV 1 room "" "" "DEPENDS;PRIVATE_DEPENDS")
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.cpp)
    set(kernels ${sources})
    list(FILTER kernels INCLUDE REGEX "_kernel\\.cpp$")
    list(FILTER sources EXCLUDE REGEX "_kernel\\.cpp$")
    set(target penumbra_${name})
    add_library(${target} STATIC ${sources})
    add_library(penumbra::${name} ALIAS ${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
    target_link_libraries(${target} PUBLIC penumbra::options ${room_DEPENDS} PRIVATE ${room_PRIVATE_DEPENDS})
    if(kernels)
        penumbra_add_kernels(${target} ${kernels})
    endif()
    set_property(GLOBAL APPEND PROPERTY PENUMBRA_LIBRARIES ${target})
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/penumbra/${folder}
            FILES_MATCHING PATTERN "*.h" PATTERN "*_kernel.h" EXCLUDE)
endfunction()
