# What every translation unit is compiled with, in one interface target.
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
if(PENUMBRA_WERROR)
    target_compile_options(penumbra_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
if(PENUMBRA_SANITIZE)
    target_compile_options(penumbra_options INTERFACE
        $<BUILD_INTERFACE:-fsanitize=${PENUMBRA_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer>)
    target_link_options(penumbra_options INTERFACE $<BUILD_INTERFACE:-fsanitize=${PENUMBRA_SANITIZE}>)
endif()
