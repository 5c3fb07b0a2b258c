#include "shadow/exact_occluders.h"

#include <utility>
#include <vector>

#include "shadow/build_tree.h"
#include "shadow/cutout_geometry.h"
#include "shadow/occlude_kernel.h"

namespace penumbra::shadow {
namespace {

// A tree and the triangles with holes that its leaves point to.
struct Group {
    TreeBuilder::Tree tree;
    std::vector<std::unique_ptr<CutoutSplit>> splits;  // own the opacity maps
    std::vector<std::unique_ptr<std::vector<CutoutTriangle>>> cutouts;
};

CutoutTriangle cutout_triangle(const CutoutGeometry& from, std::size_t index) {
    const auto& [a, b, c] = from.triangles[index].vertex;
    return {.positions = {from.positions[a], from.positions[b], from.positions[c]},
            .uvs = {from.uvs[a], from.uvs[b], from.uvs[c]},
            .map = &from.maps[from.maps_of_triangles[index]]};
}

void append(const SceneView& view, const Instance& instance, Group& group,
            std::vector<TreeTriangle>& triangles) {
    const Vec3f* const positions = instance.positions.data();
    auto split = split_cutouts(view, instance, positions);
    for (const auto& [vertices] : split->opaque) {
        const auto& [a, b, c] = vertices;
        triangles.push_back({{positions[a], positions[b], positions[c]}, nullptr});
    }
    const std::size_t count = split->cutout.triangles.size();
    if (count == 0) return;
    auto cutouts = std::make_unique<std::vector<CutoutTriangle>>();
    for (std::size_t i = 0; i < count; ++i) cutouts->push_back(cutout_triangle(split->cutout, i));
    for (const CutoutTriangle& cutout : *cutouts) {
        const auto& [a, b, c] = cutout.positions;
        triangles.push_back({{a, b, c}, &cutout});
    }
    group.cutouts.push_back(std::move(cutouts));
    group.splits.push_back(std::move(split));
}

}  // namespace

struct ExactOccluders::Implementation {
    struct Moving {
        Group group;
        Affine3f world_from_object;
        bool is_built = false;
    };

    Implementation(const parallel::Arena& arena, simd::Isa kernels)
        : builder(arena), isa(kernels) {}

    TreeBuilder builder;
    simd::Isa isa;
    Group fixed;
    std::vector<Moving> moving;  // one per instance; fixed ones have no tree
};

ExactOccluders::ExactOccluders(const parallel::Arena& arena, simd::Isa isa)
    : implementation_(std::make_unique<Implementation>(arena, isa)) {}
ExactOccluders::~ExactOccluders() = default;

void ExactOccluders::rebuild(const SceneView& view) {
    Implementation& self = *implementation_;
    self.fixed = Group{};
    self.moving.clear();
    std::vector<TreeTriangle> triangles;
    for (const Instance& instance : view.instances)
        if (!instance.is_animated) append(view, instance, self.fixed, triangles);
    self.fixed.tree = self.builder.build(triangles);
    self.moving.resize(view.instances.size());
}

void ExactOccluders::place_moving(const SceneView& view) {
    Implementation& self = *implementation_;
    for (std::size_t i = 0; i < view.instances.size(); ++i) {
        const Instance& instance = view.instances[i];
        Implementation::Moving& moving = self.moving[i];
        if (!instance.is_animated) continue;
        if (moving.is_built && moving.world_from_object == instance.world_from_object) continue;
        moving.group = Group{};
        std::vector<TreeTriangle> triangles;
        append(view, instance, moving.group, triangles);
        moving.group.tree = self.builder.build(triangles);
        moving.world_from_object = instance.world_from_object;
        moving.is_built = true;
    }
}

void ExactOccluders::occlude(const RayStream& rays) const {
    const Implementation& self = *implementation_;
    auto* const occlude_by = simd::pick(self.isa, &avx2::occlude, &avx512::occlude);
    if (!self.fixed.tree.root().is_null()) occlude_by(self.fixed.tree.root(), rays);
    for (const Implementation::Moving& moving : self.moving)
        if (!moving.group.tree.root().is_null()) occlude_by(moving.group.tree.root(), rays);
}

}  // namespace penumbra::shadow
