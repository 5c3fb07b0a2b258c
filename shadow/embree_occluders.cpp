#include "shadow/embree_occluders.h"

#include <algorithm>
#include <vector>

#include "shadow/cutout_geometry.h"
#include "shadow/embree_objects.h"

namespace penumbra::shadow {
namespace {

// Embree's callback: drops hits that fall into a hole.
void drop_holes(const RTCFilterFunctionNArguments* arguments) {
    const auto& geometry = *static_cast<const CutoutGeometry*>(arguments->geometryUserPtr);
    const unsigned lanes = arguments->N;
    for (unsigned lane = 0; lane < lanes; ++lane) {
        if (arguments->valid[lane] == 0) continue;
        RTCRayN* const ray = arguments->ray;
        const Vec3f origin = {RTCRayN_org_x(ray, lanes, lane), RTCRayN_org_y(ray, lanes, lane),
                              RTCRayN_org_z(ray, lanes, lane)};
        const Vec3f direction = {RTCRayN_dir_x(ray, lanes, lane), RTCRayN_dir_y(ray, lanes, lane),
                                 RTCRayN_dir_z(ray, lanes, lane)};
        const unsigned triangle = RTCHitN_primID(arguments->hit, lanes, lane);
        if (!geometry.is_opaque_at(triangle, origin, direction)) arguments->valid[lane] = 0;
    }
}

void set_transform(RTCGeometry geometry, const Affine3f& world_from_object) {
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, &world_from_object);
    rtcCommitGeometry(geometry);
}
static_assert(sizeof(Affine3f) == 12 * sizeof(float), "four columns of three floats");

void occlude_by(RTCScene scene, const RayStream& rays) {
    embree::Query query(embree::Order::kIncoherent);
    embree::occlude(scene, query, rays);
}

// Trees refer to the triangles and opacity maps that they were split into.
struct Tree {
    std::vector<std::unique_ptr<CutoutSplit>> splits;
    Scene scene;  // null: without triangles
};

// Where a model was when its tree was built.
struct Placement {
    const Vec3f* positions;  // world
    Affine3f world_from_object;
    friend bool operator==(const Placement&, const Placement&) = default;
};

// Indices of a view's moving instances.
struct MovingModels {
    std::vector<std::size_t> small;  // together small enough to be built anew for each frame
    std::vector<std::size_t> large;
};

MovingModels moving_models(const SceneView& view, std::size_t most_triangles) {
    MovingModels models;
    std::vector<std::size_t>& small = models.small;
    for (std::size_t i = 0; i < view.instances.size(); ++i)
        if (view.instances[i].is_animated) small.push_back(i);
    const auto size = [&](std::size_t i) { return view.instances[i].mesh->triangles.size(); };
    std::stable_sort(small.begin(), small.end(),
                     [&](std::size_t a, std::size_t b) { return size(a) < size(b); });
    std::size_t triangles = 0;
    const auto first_large = std::find_if(small.begin(), small.end(), [&](std::size_t i) {
        triangles += size(i);
        return triangles > most_triangles;
    });
    models.large.assign(first_large, small.end());
    std::sort(models.large.begin(), models.large.end());  // in the view's order
    small.erase(first_large, small.end());
    return models;
}

// Rays visit three trees, one after the other: of all that never moves; of small moving models,
// built anew where they are; and one of instances of large ones, whose own trees in object space
// are built once. None is ever refitted, since a refitted tree would depend on its history.
// Instances cost more than twice the time of triangles in world space: rays leave their packets.
class EmbreeOccluders : public OccluderTrees {
  public:
    EmbreeOccluders(const parallel::Arena& arena, TraceIsa isa, std::size_t most_rebuilt)
        : arena_(arena), most_rebuilt_(most_rebuilt), device_(new_device(isa)) {}

    void rebuild(const SceneView& view) override {
        instances_.reset();
        copies_.clear();
        models_.clear();
        moving_ = Tree{};
        placed_.clear();
        fixed_ = Tree{};
        for (const Instance& instance : view.instances)
            if (!instance.is_animated) attach_in_world(fixed_, view, instance);
        finish(fixed_);
        MovingModels moving = moving_models(view, most_rebuilt_);
        rebuilt_ = std::move(moving.small);
        for (const std::size_t i : moving.large) add_instance(view, i);
    }

    void place_moving(const SceneView& view) override {
        place_rebuilt(view);
        place_instances(view);
    }

    void occlude(const RayStream& rays) const override {
        for (RTCScene scene : {fixed_.scene.get(), moving_.scene.get(), instances_.get()})
            if (scene) occlude_by(scene, rays);
    }

  private:
    void attach_triangles(Tree& tree, const VertexSource& vertices,
                          std::span<const Triangle> triangles, const CutoutGeometry* cutout) const {
        if (triangles.empty()) return;
        if (!tree.scene) tree.scene = new_scene(device_.get());
        const Geometry geometry = new_triangles(device_.get(), vertices, triangles);
        if (cutout) {
            rtcSetGeometryUserData(geometry.get(), const_cast<CutoutGeometry*>(cutout));
            rtcSetGeometryOccludedFilterFunction(geometry.get(), &drop_holes);
        }
        attach(tree.scene.get(), geometry);
        check(device_.get(), "filling the shadow rays' tree");
    }

    // Opaque triangles and those with holes are geometries of their own: only the latter ask back.
    void attach_model(Tree& tree, const SceneView& view, const Instance& instance,
                      const VertexSource& vertices) const {
        auto split = split_cutouts(view, instance, vertices.positions);
        attach_triangles(tree, vertices, split->opaque, nullptr);
        attach_triangles(tree, vertices, split->cutout.triangles, &split->cutout);
        tree.splits.push_back(std::move(split));
    }

    void attach_in_world(Tree& tree, const SceneView& view, const Instance& instance) const {
        attach_model(tree, view, instance,
                     {instance.positions.data(), instance.mesh->positions.size(), true});
    }

    void finish(const Tree& tree) const {
        if (tree.scene) commit(device_.get(), tree.scene.get(), arena_);
    }

    // A model's tree; models that share mesh and materials share it.
    RTCScene object_tree(const SceneView& view, const Instance& instance) {
        for (const Model& other : models_)
            if (other.mesh == instance.mesh && other.materials == instance.materials.data())
                return other.tree.scene.get();
        Model model{instance.mesh, instance.materials.data(), {}};
        attach_model(model.tree, view, instance,
                     {instance.mesh->positions.data(), instance.mesh->positions.size(), false});
        finish(model.tree);
        models_.push_back(std::move(model));
        return models_.back().tree.scene.get();
    }

    void add_instance(const SceneView& view, std::size_t index) {
        RTCScene of = object_tree(view, view.instances[index]);
        if (!of) return;
        if (!instances_) instances_ = new_scene(device_.get());
        Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE));
        rtcSetGeometryInstancedScene(geometry.get(), of);
        set_transform(geometry.get(), Affine3f{});
        rtcAttachGeometry(instances_.get(), geometry.get());
        copies_.push_back({index, std::move(geometry), {}, false});
    }

    void place_rebuilt(const SceneView& view) {
        std::vector<Placement> now;
        for (const std::size_t i : rebuilt_)
            now.push_back(
                {view.instances[i].positions.data(), view.instances[i].world_from_object});
        if (now == placed_) return;
        placed_.clear();  // after a failure, the next call begins anew
        moving_ = Tree{};
        for (const std::size_t i : rebuilt_) attach_in_world(moving_, view, view.instances[i]);
        finish(moving_);
        placed_ = std::move(now);
    }

    void place_instances(const SceneView& view) {
        bool changed = false;
        for (Copy& copy : copies_) {
            const Affine3f& now = view.instances[copy.index].world_from_object;
            if (copy.is_placed && copy.world_from_object == now) continue;
            set_transform(copy.geometry.get(), now);
            copy.world_from_object = now;
            copy.is_placed = changed = true;
        }
        if (changed) commit(device_.get(), instances_.get(), arena_);
    }

    struct Model {
        const Mesh* mesh;
        const std::uint32_t* materials;
        Tree tree;  // object space
    };
    struct Copy {
        std::size_t index;  // of the view's instances
        Geometry geometry;
        Affine3f world_from_object;
        bool is_placed;
    };

    const parallel::Arena& arena_;
    std::size_t most_rebuilt_;
    Device device_;
    Tree fixed_;
    std::vector<std::size_t> rebuilt_;  // of the view's instances
    std::vector<Placement> placed_;     // of those, as they are in `moving_`
    Tree moving_;
    std::vector<Model> models_;
    std::vector<Copy> copies_;
    Scene instances_;  // null: no model is large
};

}  // namespace

std::unique_ptr<OccluderTrees> make_embree_occluders(const parallel::Arena& arena, TraceIsa isa,
                                                     std::size_t most_rebuilt) {
    return std::make_unique<EmbreeOccluders>(arena, isa, most_rebuilt);
}

}  // namespace penumbra::shadow
