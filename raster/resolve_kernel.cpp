#include "raster/resolve_kernel.h"

#include "core/bsdf/ggx.h"
#include "core/simd/kernel.h"
#include "raster/surface_formulas.h"

namespace penumbra::PENUMBRA_ISA {
namespace {

using namespace raster;

// A vector of pixels, or some of its lanes: where results go.
struct Target {
    int x, y;  // of the first lane, in the tile
    M lanes;
    bool whole;  // all lanes

    void put(PlaneView<float> plane, F value) const {
        if (!plane) return;
        float* const to = plane.row(y) + x;
        simd::store(to, whole ? value : simd::select(lanes, value, simd::load<F>(to)));
    }
    void put(PlaneView<std::uint32_t> plane, U value) const {
        if (!plane) return;
        std::uint32_t* const to = plane.row(y) + x;
        simd::store(to, whole ? value : simd::select(lanes, value, simd::load<U>(to)));
    }
    void put(const PlaneView3<float>& planes, const Vec3<F>& value) const {
        put(planes[0], value.x);
        put(planes[1], value.y);
        put(planes[2], value.z);
    }
};

// ---- reading triangles -------------------------------------------------------------------------

Vec3<F> load_vec3(const float* base, std::int32_t vertex) {
    const float* const from = base + std::size_t(vertex) * 3;
    return {F(from[0]), F(from[1]), F(from[2])};
}
Vec3<F> load_vec3(const float* base, I vertex) {
    const I at = vertex * I(3);
    return {simd::gather(base, at), simd::gather(base + 1, at), simd::gather(base + 2, at)};
}
Vec2<F> load_vec2(const float* base, std::int32_t vertex) {
    const float* const from = base + std::size_t(vertex) * 2;
    return {F(from[0]), F(from[1])};
}
Vec2<F> load_vec2(const float* base, I vertex) {
    const I at = vertex * I(2);
    return {simd::gather(base, at), simd::gather(base + 1, at)};
}
std::int32_t load_index(const std::int32_t* base, std::int32_t triangle, int k) {
    return base[std::size_t(triangle) * 3 + k];
}
I load_index(const std::int32_t* base, I triangle, int k) {
    return simd::gather(base + k, triangle * I(3));
}

// `Index` is one triangle for all lanes, or one per lane: the same values either way.
template <class Index>
SurfaceTriangle<F> load_triangle(const InstanceTable& instance, Index triangle) {
    SurfaceTriangle<F> result;
    for (int k = 0; k < 3; ++k) {
        const Index vertex = load_index(instance.vertices, triangle, k);
        result.positions[k] = load_vec3(instance.positions, vertex);
        result.normals[k] = load_vec3(instance.normals, vertex);
        result.uvs[k] = instance.uvs ? load_vec2(instance.uvs, vertex) : Vec2<F>{F(0), F(0)};
    }
    return result;
}

// ---- lanes that show one instance and one material
// -----------------------------------------------

struct Group {
    Target target;
    std::uint32_t instance, material;
    SurfaceTriangle<F> triangle;
};

void put_material(const ResolveJob& job, const Target& target, const MaterialTable& material,
                  const TextureFootprint<F>& footprint, M emits) {
    const SurfaceView& out = job.surface;
    Vec3<F> base_color = broadcast<F>(material.base_color);
    F roughness(material.roughness);
    F metallic(material.metallic);
    if (material.base_color_map && out.base_color[0])
        base_color = base_color * sample(material.base_color_map, footprint);
    if (material.roughness_map && out.roughness)
        roughness *= sample_red(material.roughness_map, footprint);
    if (material.metallic_map && out.metallic)
        metallic *= sample_red(material.metallic_map, footprint);
    const Vec3<F> dark{F(0), F(0), F(0)};
    target.put(out.base_color, base_color);
    target.put(out.roughness, simd::clamp(roughness, F(kMinimumRoughness), F(1)));
    target.put(out.metallic, metallic);
    target.put(out.dielectric_f0, F(material.dielectric_f0));
    target.put(out.emission, select(emits, broadcast<F>(material.emission), dark));
}

Vec3<F> smooth_normal(const Group& group, const MaterialTable& material,
                      const SurfacePoint<F>& point, const TextureFootprint<F>& footprint) {
    const Vec3<F> interpolated = interpolate(group.triangle.normals, point.weights);
    const Vec3<F> smooth = direction_or(interpolated, point.geometric_normal);
    if (!material.normal_map) return smooth;
    const Vec3<F> texel = sample(material.normal_map, footprint);
    const auto centred = [](F x) { return simd::fma(x, F(2), F(-1)); };
    return mapped_normal(group.triangle, point, smooth,
                         {centred(texel.x), centred(texel.y), centred(texel.z)});
}

void put_normals(const ResolveJob& job, const Group& group, const SurfacePoint<F>& point,
                 const TextureFootprint<F>& footprint) {
    const SurfaceView& out = job.surface;
    group.target.put(out.geometric_normal, point.geometric_normal);
    const M away = normals_face_away(group.triangle, point.geometric_normal);
    if (out.normal[0]) {
        const Vec3<F> normal =
            smooth_normal(group, job.materials[group.material], point, footprint);
        group.target.put(out.normal, bent_to_viewer(select(away, -normal, normal), point));
    }
    if (out.shadow_origin[0]) {
        const Vec3<F> offset = shadow_offset(group.triangle, point, away);
        group.target.put(out.shadow_origin,
                         group.triangle.positions[0] + (point.from_vertex + offset));
    }
}

void resolve_group(const ResolveJob& job, const Group& group) {
    const InstanceTable& instance = job.instances[group.instance];
    const MaterialTable& material = job.materials[group.material];
    const SurfaceView& out = job.surface;
    const Target& target = group.target;
    const F x =
        F(static_cast<float>(job.tile.x0 + target.x) + 0.5f) + simd::to_float(simd::iota<I>());
    const F y(static_cast<float>(job.tile.y0 + target.y) + 0.5f);
    const Vec3<F> direction = job.camera.direction(x, y);
    const SurfacePoint<F> point = surface_point(group.triangle, job.camera, direction);
    const Vec3<F> position = group.triangle.positions[0] + point.from_vertex;
    target.put(out.position, position);
    target.put(out.depth, point.depth);

    const TextureFootprint<F> footprint =
        texture_footprint(job.camera, group.triangle, point, direction);
    put_normals(job, group, point, footprint);
    put_material(job, target, material, footprint, point.is_front ^ M(instance.flips_winding));
    if (out.motion_x || out.motion_y) {
        const Vec2<F> moved =
            pixel_motion(job.camera, position, job.previous_camera,
                         broadcast<F>(instance.previous_from_current).point(position));
        target.put(out.motion_x, moved.x);
        target.put(out.motion_y, moved.y);
    }
    target.put(out.material, U(group.material));
}

// ---- vectors of pixels -------------------------------------------------------------------------

void put_nothing(const ResolveJob& job, const Target& target) {
    const SurfaceView& out = job.surface;
    const Vec3<F> zero{F(0), F(0), F(0)};
    for (const PlaneView3<float>* planes :
         {&out.position, &out.shadow_origin, &out.geometric_normal, &out.normal, &out.base_color})
        target.put(*planes, zero);
    for (const PlaneView<float>& plane :
         {out.roughness, out.metallic, out.dielectric_f0, out.motion_x, out.motion_y})
        target.put(plane, F(0));
    target.put(out.emission, broadcast<F>(job.background));
    target.put(out.depth, F(kDepthOfNothing));
    target.put(out.material, U(kNothing));
}

std::uint32_t material_of(const InstanceTable& instance, std::uint32_t triangle) {
    return instance.materials[instance.slots[triangle]];
}

// The lanes of `rest` that show the same instance and material as its lowest.
Group first_group(const ResolveJob& job, int x, int y, std::uint32_t rest) {
    const std::uint32_t* const instances = job.visibility.instance.row(y) + x;
    const std::uint32_t* const triangles = job.visibility.triangle.row(y) + x;
    const int lane = __builtin_ctz(rest);
    const std::uint32_t triangle = triangles[lane];
    Group group{};
    group.instance = instances[lane];
    const InstanceTable& instance = job.instances[group.instance];
    group.material = material_of(instance, triangle);

    const U lane_triangles = simd::load<U>(triangles);
    const M same_instance = simd::load<U>(instances) == U(group.instance);
    M lanes = same_instance & (lane_triangles == U(triangle));
    const bool one_triangle = simd::bits(lanes) == simd::bits(same_instance);
    if (!one_triangle) {
        alignas(64) std::uint32_t same_material[kLanes];
        const std::uint32_t candidates = simd::bits(same_instance);
        for (int k = 0; k < kLanes; ++k)
            same_material[k] =
                (candidates >> k & 1) != 0 && material_of(instance, triangles[k]) == group.material;
        lanes = simd::load<U>(same_material) != U(0);
    }
    group.target = {x, y, lanes, simd::all(lanes)};
    if (one_triangle)
        group.triangle = load_triangle(instance, static_cast<std::int32_t>(triangle));
    else
        group.triangle =
            load_triangle(instance, I(simd::select(lanes, lane_triangles, U(triangle))));
    return group;
}

void resolve_vector(const ResolveJob& job, int x, int y) {
    const U instance = simd::load<U>(job.visibility.instance.row(y) + x);
    const Target all{x, y, M(true), true};
    all.put(job.surface.instance, instance);
    all.put(job.surface.triangle, simd::load<U>(job.visibility.triangle.row(y) + x));
    std::uint32_t rest = simd::bits(instance != U(kNothing));
    if (rest != (1u << kLanes) - 1) put_nothing(job, all);
    while (rest != 0) {
        const Group group = first_group(job, x, y, rest);
        resolve_group(job, group);
        rest &= ~simd::bits(group.target.lanes);
    }
}

}  // namespace

void resolve_tile(const ResolveJob& job) {
    for (int y = 0; y < kTileSize; ++y)
        for (int x = 0; x < kTileSize; x += kLanes) resolve_vector(job, x, y);
}

}  // namespace penumbra::PENUMBRA_ISA
