# penumbra_embed_files(TARGET NAMESPACE FILE...): compiles the files' bytes into TARGET, as the function
# `std::span<const EmbeddedFile> NAMESPACE::embedded_files()` (core/embedded_file.h), which the room declares for
# itself. Once per target.
function(penumbra_embed_files target namespace)
    set(assembly "")
    set(declarations "")
    set(entries "")
    set(index 0)
    foreach(file IN LISTS ARGN)
        get_filename_component(name ${file} NAME)
        set(symbol penumbra_embedded_${index})
        string(APPEND assembly "${symbol}: .incbin \"${file}\"\n${symbol}_end:\n")
        string(APPEND declarations "__attribute__((visibility(\"hidden\"))) extern const char ${symbol}[], ${symbol}_end[];\n")
        string(APPEND entries "        {\"${name}\", {${symbol}, ${symbol}_end}},\n")
        math(EXPR index "${index} + 1")
    endforeach()
    set(source ${CMAKE_CURRENT_BINARY_DIR}/embedded_files.cpp)
    file(CONFIGURE OUTPUT ${source} @ONLY CONTENT
"#include <span>

#include \"core/embedded_file.h\"

asm(R\"(
.pushsection .rodata
@assembly@.popsection
)\");
extern \"C\" {
@declarations@}
namespace @namespace@ {
std::span<const EmbeddedFile> embedded_files();
std::span<const EmbeddedFile> embedded_files() {
    static const EmbeddedFile kFiles[] = {
@entries@    };
    return kFiles;
}
}
")
    # By itself: what is compiled together with others loses what it depends on.
    set_source_files_properties(${source} PROPERTIES OBJECT_DEPENDS "${ARGN}" SKIP_UNITY_BUILD_INCLUSION ON)
    target_sources(${target} PRIVATE ${source})
endfunction()
