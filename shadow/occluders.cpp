#include "shadow/occluders.h"

#include <vector>

#include "core/simd/isa.h"
#include "shadow/embree_occluders.h"
#include "shadow/exact_occluders.h"
#include "shadow/triangle_extent.h"

namespace penumbra::shadow {
namespace {

// What a model's tree is made of, if it does not move. Equal sources give equal trees.
struct Source {
    const Mesh* mesh;
    const Vec3f* positions;  // world; null for what moves
    const std::uint32_t* materials;
    Affine3f world_from_object;  // identity for what moves
    bool moves;
    friend bool operator==(const Source&, const Source&) = default;
};

std::vector<Source> sources_of(const SceneView& view) {
    std::vector<Source> sources;
    sources.reserve(view.instances.size());
    for (const Instance& instance : view.instances) {
        const bool moves = instance.is_animated;
        sources.push_back({instance.mesh, moves ? nullptr : instance.positions.data(),
                           instance.materials.data(),
                           moves ? Affine3f{} : instance.world_from_object, moves});
    }
    return sources;
}

std::unique_ptr<OccluderTrees> make_trees(const parallel::Arena& arena,
                                          const OccluderSettings& settings) {
    if (settings.test == HitTest::kExact)
        return make_exact_occluders(arena, settings.kernels.value_or(simd::best_isa()));
    return make_embree_occluders(arena, settings.isa, settings.most_rebuilt);
}

}  // namespace

struct Occluders::Implementation {
    Implementation(const parallel::Arena& arena_to_use, const OccluderSettings& settings)
        : arena(arena_to_use), trees(make_trees(arena, settings)) {}

    void rebuild(const SceneView& view) {
        trees->rebuild(view);
        extents.resize(view.instances.size());
        for (std::size_t i = 0; i < view.instances.size(); ++i)
            extents[i] = triangle_extents(arena, view.instances[i]);
    }

    const parallel::Arena& arena;
    std::unique_ptr<OccluderTrees> trees;
    std::vector<Source> sources;
    bool is_built = false;  // from `sources`
    std::vector<TriangleExtents> extents;
    std::vector<float> scales;
};

Occluders::Occluders(const parallel::Arena& arena, const OccluderSettings& settings)
    : implementation_(std::make_unique<Implementation>(arena, settings)) {}
Occluders::~Occluders() = default;

void Occluders::update(const SceneView& view) {
    Implementation& self = *implementation_;
    std::vector<Source> sources = sources_of(view);
    if (!self.is_built || sources != self.sources) {
        self.is_built = false;
        self.sources.clear();  // after a failure, the next update begins anew
        self.rebuild(view);
        self.sources = std::move(sources);
        self.is_built = true;
    }
    self.trees->place_moving(view);
    self.scales.resize(view.instances.size());
    for (std::size_t i = 0; i < view.instances.size(); ++i)
        self.scales[i] = offset_scale(self.extents[i], view.instances[i]);
}

std::span<const float> Occluders::offset_scales() const {
    return implementation_->scales;
}

void Occluders::occlude(const RayStream& rays) const {
    implementation_->trees->occlude(rays);
}

}  // namespace penumbra::shadow
