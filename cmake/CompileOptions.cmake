# What every translation unit is compiled with, in one interface target.

# What was compiled before is not compiled again.
find_program(PENUMBRA_CCACHE ccache)
mark_as_advanced(PENUMBRA_CCACHE)
if(PENUMBRA_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${PENUMBRA_CCACHE})
endif()

add_library(penumbra_options INTERFACE)
add_library(penumbra::options ALIAS penumbra_options)
target_include_directories(penumbra_options INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/penumbra>)
target_compile_features(penumbra_options INTERFACE cxx_std_20)
# The same bits everywhere: no contraction to fused operations that the source does not name.
target_compile_options(penumbra_options INTERFACE -ffp-contract=off)
# Designated initialisers leave out what has its default.
target_compile_options(penumbra_options INTERFACE
    $<BUILD_INTERFACE:-Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Wno-missing-field-initializers>)
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # g++ takes sources that are compiled several at once for headers.
    target_compile_options(penumbra_options INTERFACE $<BUILD_INTERFACE:-Wno-subobject-linkage>)
endif()
if(PENUMBRA_WERROR)
    target_compile_options(penumbra_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(PENUMBRA_SANITIZE)
    target_compile_options(penumbra_options INTERFACE
        $<BUILD_INTERFACE:-fsanitize=${PENUMBRA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer>)
    target_link_options(penumbra_options INTERFACE $<BUILD_INTERFACE:-fsanitize=${PENUMBRA_SANITIZE}>)
endif()
