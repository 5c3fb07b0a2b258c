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

class ExactOccluders : public OccluderTrees {
  public:
    ExactOccluders(const parallel::Arena& arena, simd::Isa isa) : builder_(arena), isa_(isa) {}

    void rebuild(const SceneView& view) override {
        fixed_ = Group{};
        moving_.clear();
        std::vector<TreeTriangle> triangles;
        for (const Instance& instance : view.instances)
            if (!instance.is_animated) append(view, instance, fixed_, triangles);
        fixed_.tree = builder_.build(triangles);
        moving_.resize(view.instances.size());
    }

    void place_moving(const SceneView& view) override {
        for (std::size_t i = 0; i < view.instances.size(); ++i) {
            const Instance& instance = view.instances[i];
            Moving& moving = moving_[i];
            if (!instance.is_animated) continue;
            if (moving.is_built && moving.world_from_object == instance.world_from_object) continue;
            moving.group = Group{};
            std::vector<TreeTriangle> triangles;
            append(view, instance, moving.group, triangles);
            moving.group.tree = builder_.build(triangles);
            moving.world_from_object = instance.world_from_object;
            moving.is_built = true;
        }
    }

    void occlude(const RayStream& rays) const override {
        auto* const occlude_by = simd::pick(isa_, &avx2::occlude, &avx512::occlude);
        if (!fixed_.tree.root().is_null()) occlude_by(fixed_.tree.root(), rays);
        for (const Moving& moving : moving_)
            if (!moving.group.tree.root().is_null()) occlude_by(moving.group.tree.root(), rays);
    }

  private:
    struct Moving {
        Group group;
        Affine3f world_from_object;
        bool is_built = false;
    };

    TreeBuilder builder_;
    simd::Isa isa_;
    Group fixed_;
    std::vector<Moving> moving_;  // one per instance; fixed ones have no tree
};

}  // namespace

std::unique_ptr<OccluderTrees> make_exact_occluders(const parallel::Arena& arena, simd::Isa isa) {
    return std::make_unique<ExactOccluders>(arena, isa);
}

}  // namespace penumbra::shadow
