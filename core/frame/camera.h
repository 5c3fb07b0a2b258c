#pragma once

#include "core/math/vec.h"

// The camera of one frame: a pinhole.

namespace penumbra {

// Pixel (x, y) has its centre at (x + 0.5, y + 0.5), x to the right and y down from the frame's top
// left. A point at view-space (right, up, forward) = (a, b, z), z > 0, falls on pixel position
//   x = center_x + focal * a / z,   y = center_y - focal * b / z.
struct Camera {
    Vec3f eye;                 // world
    Vec3f right, up, forward;  // orthonormal; right = forward x up
    float focal = 1;           // pixels; pixels are square
    float center_x = 0;        // pixels: half the size, plus the sub-pixel jitter of an --aa pass
    float center_y = 0;
    float near_distance = 0.01f;  // along `forward`, metres

    // (right, up, forward) coordinates of a world point.
    template <class F>
    [[nodiscard]] Vec3<F> view_from_world(const Vec3<F>& p) const {
        const Vec3<F> d = p - broadcast<F>(eye);
        return {dot(d, broadcast<F>(right)), dot(d, broadcast<F>(up)),
                dot(d, broadcast<F>(forward))};
    }
    // The direction through a pixel position, scaled so that its view depth is 1.
    template <class F>
    [[nodiscard]] Vec3<F> direction(F x, F y) const {
        const F a = (x - F(center_x)) / F(focal);
        const F b = (F(center_y) - y) / F(focal);
        return fma(broadcast<F>(right), a, fma(broadcast<F>(up), b, broadcast<F>(forward)));
    }
};

// The pixel position of a view-space point before the camera.
template <class F>
Vec2<F> project(const Camera& camera, const Vec3<F>& view) {
    const F scale = F(camera.focal) / view.z;
    return {simd::fma(view.x, scale, F(camera.center_x)),
            simd::fma(-view.y, scale, F(camera.center_y))};
}

// Pixel position now minus in the previous frame, of a point at these world positions. Both are
// projected from rounded positions, so that what stands still moves by exactly 0. A point that was
// behind the previous camera's near plane is taken to have been on it.
template <class F>
Vec2<F> pixel_motion(const Camera& now, const Vec3<F>& position, const Camera& previous,
                     const Vec3<F>& position_before) {
    Vec3<F> view = previous.view_from_world(position_before);
    view.z = simd::max(view.z, F(previous.near_distance));
    return project(now, now.view_from_world(position)) - project(previous, view);
}

}  // namespace penumbra
