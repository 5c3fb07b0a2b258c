#include "apps/bench/workload.h"

#include <algorithm>
#include <limits>

#include "core/parallel/tiles.h"
#include "shadow/z_order.h"

namespace penumbra::bench {
namespace {

constexpr std::uint64_t kBytesPerRay = 7 * sizeof(float);

// The pixels of a tile in the order in which the shadow pass packs its rays.
template <class Body>
void each_pixel_in_z_order(const Body& body) {
    for (const shadow::SquarePlace place : shadow::kSquaresInZOrder)
        for (int y = 0; y < shadow::kSquare; ++y)
            for (int x = 0; x < shadow::kSquare; ++x) body(place.x + x, place.y + y);
}

void add_active(const shadow::RayScratch& rays, shadow::RayBatch& batch) {
    each_pixel_in_z_order([&](int x, int y) {
        if (!(rays.active[static_cast<std::size_t>(y)] >> x & 1u)) return;
        const auto vector = [&](const Plane3<float>& p) {
            return Vec3f{p[0].at(x, y), p[1].at(x, y), p[2].at(x, y)};
        };
        batch.add(vector(rays.origin), vector(rays.direction), rays.range.at(x, y));
    });
}

shadow::RayBatch primary_rays(const Camera& camera, const PixelRect& pixels, const Tile& tile) {
    shadow::RayBatch batch;
    each_pixel_in_z_order([&](int i, int j) {
        const int x = tile.x0 + i;
        const int y = tile.y0 + j;
        if (x < pixels.x0 || x >= pixels.x1 || y < pixels.y0 || y >= pixels.y1) return;
        const Vec3f direction =
            camera.direction(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
        batch.add(camera.eye, direction, std::numeric_limits<float>::infinity());
    });
    batch.pad();
    return batch;
}

std::uint64_t count_covered(const renderer::Film& film) {
    const Plane<float>& coverage = film.numbers(renderer::Aov::kBeauty, 3);
    std::uint64_t covered = 0;
    for (int y = film.crop.y0 - film.window.y0; y < film.crop.y1 - film.window.y0; ++y)
        for (int x = film.crop.x0 - film.window.x0; x < film.crop.x1 - film.window.x0; ++x)
            covered += coverage.at(x, y) > 0;
    return covered;
}

// One tile's, of all its lights and samples.
struct TileRays {
    shadow::RayBatch batch;
    std::uint64_t rays = 0;
};

// The kept shadow rays, and primary ones for the same tiles.
void take_rays(std::vector<TileRays>& tiles, const parallel::TileGrid& grid, const PixelRect& seen,
               Workload& work) {
    std::uint64_t kept = 0;
    for (int i = 0; i < grid.count(); ++i) {
        TileRays& tile = tiles[static_cast<std::size_t>(i)];
        work.shadow_rays += tile.rays;
        kept += static_cast<std::uint64_t>(tile.batch.count);
        tile.batch.pad();
        work.shadow.push_back(std::move(tile.batch));
        work.primary.push_back(primary_rays(work.view.camera, seen, grid.tile(i)));
    }
    if (kept > 0)
        work.shadow_scale = static_cast<double>(work.shadow_rays) / static_cast<double>(kept);
}

void count_scene(Workload& work) {
    for (const Instance& instance : work.view.instances) {
        work.vertices += instance.mesh->positions.size();
        work.triangles += instance.mesh->triangles.size();
    }
}

}  // namespace

Workload record_workload(const Scene& scene, const renderer::ImageSettings& image,
                         const renderer::ExecutionSettings& execution, int frame,
                         std::uint64_t memory, const std::atomic<bool>* cancelled) {
    const renderer::ImageSettings all = renderer::completed(scene, image);
    Workload work;
    evaluate(scene, times_of_frame(scene.animation, frame),
             {.width = all.width, .height = all.height}, work.view);
    count_scene(work);

    const auto samples = static_cast<std::uint64_t>(all.samples_per_pixel * all.passes);
    work.pixels = static_cast<std::uint64_t>(all.crop->width()) *
                  static_cast<std::uint64_t>(all.crop->height());
    const std::uint64_t most =
        kBytesPerRay * work.pixels * samples * std::max<std::size_t>(work.view.lights.size(), 1);
    const auto stride = static_cast<int>(most / std::max<std::uint64_t>(memory, 1) + 1);

    // Tile indices count within the rendered window, which the film knows only after the frame.
    std::vector<TileRays> tiles(
        static_cast<std::size_t>((all.width / kTileSize + 2) * (all.height / kTileSize + 2)));
    const renderer::RayObserver keep = [&](const Tile& tile, const shadow::RayScratch& rays) {
        TileRays& kept = tiles[static_cast<std::size_t>(tile.index)];
        kept.rays += rays.count_active();
        if (tile.index % stride == 0) add_active(rays, kept.batch);
    };
    renderer::ExecutionSettings observed = execution;
    observed.on_rays = &keep;
    renderer::Renderer renderer(scene, image, observed);
    renderer::Film film;
    renderer.render(frame, {renderer::Aov::kBeauty}, film, cancelled);

    take_rays(tiles, parallel::TileGrid(film.window), {0, 0, all.width, all.height}, work);
    work.covered_pixels = count_covered(film);
    work.shaded_pairs = work.shadow_rays / samples;
    int fewest = kMaxLightVertices;
    for (const PolygonLight& light : work.view.lights.polygons)
        fewest = std::min(fewest, light.shape.count);
    work.shaded_vertices = work.shaded_pairs * static_cast<std::uint64_t>(fewest);
    return work;
}

}  // namespace penumbra::bench
