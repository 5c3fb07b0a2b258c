// What --reproducible costs: the same frames with Embree's triangles and with our own, in turns, in
// one run; medians of the ratios.
//
//     reproducible_price SCENE|builtin [PAIRS] [THREADS] [SIZE, e.g. 1920x1080] [avx2|avx512]
//
// Embree runs with AVX2, its default here; the last argument is the kernels' instruction set.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "apps/renderer/builtin_scene.h"
#include "apps/renderer/renderer.h"
#include "core/scene/read_scene.h"

using namespace penumbra;

namespace {

struct Times {
    std::vector<double> frame, trace, evaluate;
};

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double median_ratio(const std::vector<double>& over, const std::vector<double>& under) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < over.size(); ++i) ratios.push_back(over[i] / under[i]);
    return median(ratios);
}

void measure(renderer::Renderer& renderer, renderer::Film& film, Times& times) {
    const renderer::FrameStatistics s =
        renderer.render(1, renderer::parse_aov_list("beauty"), film);
    times.frame.push_back(s.render_seconds);
    times.trace.push_back(s.passes[renderer::Pass::kTrace]);
}

double first_frame(renderer::Renderer& renderer, renderer::Film& film) {
    return renderer.render(1, renderer::parse_aov_list("beauty"), film)
        .passes[renderer::Pass::kEvaluate];
}

// Pixels whose light differs in any bit.
double differing_share(const renderer::Film& a, const renderer::Film& b) {
    long differing = 0, all = 0;
    for (int y = 0; y < a.beauty[0].height(); ++y)
        for (int x = 0; x < a.beauty[0].width(); ++x, ++all)
            differing += a.beauty[0].at(x, y) != b.beauty[0].at(x, y) ||
                         a.beauty[1].at(x, y) != b.beauty[1].at(x, y) ||
                         a.beauty[2].at(x, y) != b.beauty[2].at(x, y);
    return static_cast<double>(differing) / static_cast<double>(std::max(all, 1L));
}

void run(const Scene& scene, renderer::ImageSettings image,
         const renderer::ExecutionSettings& execution, int pairs) {
    renderer::Renderer fast(scene, image, execution);
    image.reproducible = true;
    renderer::Renderer exact(scene, image, execution);
    renderer::Film fast_film, exact_film;
    const double fast_build = first_frame(fast, fast_film);
    const double exact_build = first_frame(exact, exact_film);
    Times with, without;
    for (int pair = 0; pair < pairs; ++pair) {
        measure(fast, fast_film, without);
        measure(exact, exact_film, with);
    }
    const auto row = [](const char* what, double before, double after, double ratio) {
        fmt::print("{:<34} {:9.1f} {:9.1f} ms  x {:.2f}\n", what, 1e3 * before, 1e3 * after, ratio);
    };
    fmt::print("{:<34} {:>9} {:>9}\n", "", "Embree", "exact");
    row("frame", median(without.frame), median(with.frame),
        median_ratio(with.frame, without.frame));
    row("trace, summed over threads", median(without.trace), median(with.trace),
        median_ratio(with.trace, without.trace));
    row("first evaluation, trees included", fast_build, exact_build, exact_build / fast_build);
    fmt::print("pixels that differ: {:.2g}\n", differing_share(fast_film, exact_film));
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr,
                   "usage: reproducible_price SCENE|builtin [PAIRS] [THREADS] [WxH] [ISA]\n");
        return 2;
    }
    try {
        const int pairs = argc > 2 ? std::atoi(argv[2]) : 11;
        renderer::ExecutionSettings execution{.threads = argc > 3 ? std::atoi(argv[3]) : 2};
        renderer::ImageSettings image{.width = 1920, .height = 1080, .samples_per_pixel = 1};
        if (argc > 4 && std::sscanf(argv[4], "%dx%d", &image.width, &image.height) != 2) return 2;
        if (argc > 5)
            execution.isa =
                std::string_view(argv[5]) == "avx512" ? simd::Isa::kAvx512 : simd::Isa::kAvx2;
        const Scene scene = std::string_view(argv[1]) == "builtin" ? renderer::read_builtin_scene()
                                                                   : read_scene(argv[1]);
        run(scene, image, execution, std::max(pairs, 1));
    } catch (const std::exception& e) {
        fmt::print(stderr, "error: {}\n", e.what());
        return 1;
    }
}
