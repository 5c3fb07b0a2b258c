#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "core/parallel/arena.h"

// Every test computes as the program does: with denormals flushed.
int main(int argc, char** argv) {
    const penumbra::parallel::FlushDenormals flush;
    doctest::Context context(argc, argv);
    return context.run();
}
