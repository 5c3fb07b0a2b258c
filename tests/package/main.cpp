#include <cmath>
#include <cstdio>

#include "apps/renderer/builtin_scene.h"
#include "apps/renderer/renderer.h"
#include "core/light/polygon.h"

// Calls a formula for one shading point, and renders a small frame.
int main() {
    using namespace penumbra;
    const Scene scene = renderer::read_builtin_scene();
    renderer::Renderer renderer(scene, {.width = 64, .height = 36}, {.threads = 1});
    renderer::Film film;
    renderer.render(1, {renderer::Aov::kBeauty}, film);
    double sum = 0;
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 64; ++x) sum += film.beauty[1].at(x, y);
    std::printf("mean radiance %g\n", sum / (64 * 36));
    return std::isfinite(sum) && sum > 0 ? 0 : 1;
}
