#include "apps/renderer/deposit.h"

namespace penumbra::renderer {
namespace {

// One tile's place on the film. Loops run over whole rows of a tile: planes are padded to whole
// tiles.
class Place {
  public:
    Place(const Tile& tile, int pass, const Film& film)
        : x_(tile.x0 - film.window.x0), y_(tile.y0 - film.window.y0), is_first_(pass == 0) {}

    // What of several passes only the first leaves.
    template <class T>
    void once(PlaneView<const T> from, Plane<T>& to) const {
        if (to.empty() || !is_first_) return;
        each_row(to, [&](int y, T* row) { std::copy_n(from.row(y), kTileSize, row); });
    }
    // What is averaged over the passes.
    void sum(PlaneView<const float> from, Plane<float>& to) const {
        if (is_first_) return once(from, to);
        if (to.empty()) return;
        each_row(to, [&](int y, float* row) {
            const float* source = from.row(y);
            for (int x = 0; x < kTileSize; ++x) row[x] += source[x];
        });
    }
    void once3(const PlaneView3<const float>& from, Plane3<float>& to) const {
        for (std::size_t i = 0; i < 3; ++i) once(from[i], to[i]);
    }
    void sum3(const PlaneView3<const float>& from, Plane3<float>& to) const {
        for (std::size_t i = 0; i < 3; ++i) sum(from[i], to[i]);
    }
    // The sum of two planes, as one term: diffuse + glossy.
    void sum_of(PlaneView<const float> a, PlaneView<const float> b, Plane<float>& to) const {
        each_row(to, [&](int y, float* row) {
            const float* p = a.row(y);
            const float* q = b.row(y);
            for (int x = 0; x < kTileSize; ++x)
                row[x] = (is_first_ ? 0.0f : row[x]) + (p[x] + q[x]);
        });
    }
    // 1 where something is hit; a visible light has a depth, but no id.
    void coverage(PlaneView<const float> depth, Plane<float>& to) const {
        each_row(to, [&](int y, float* row) {
            const float* z = depth.row(y);
            for (int x = 0; x < kTileSize; ++x)
                row[x] = (is_first_ ? 0.0f : row[x]) + (z[x] < kDepthOfNothing ? 1.0f : 0.0f);
        });
    }

  private:
    template <class T, class Body>
    void each_row(Plane<T>& plane, const Body& body) const {
        for (int y = 0; y < kTileSize; ++y) body(y, plane.row(y_ + y) + x_);
    }

    int x_, y_;
    bool is_first_;
};

void scale(Plane<float>& plane, float factor, int y0, int y1) {
    if (plane.empty()) return;
    for (int y = y0; y < y1; ++y) {
        float* row = plane.row(y);
        for (std::ptrdiff_t x = 0; x < plane.stride(); ++x) row[x] *= factor;
    }
}

}  // namespace

void deposit(const Tile& tile, const ConstSurfaceView& surface, const ConstLightSumsView& sums,
             int pass, Film& film) {
    const Place place(tile, pass, film);
    Term& total = film.total();
    for (std::size_t i = 0; i < 3; ++i)
        place.sum_of(sums.unshadowed_diffuse[i], sums.unshadowed_glossy[i], total.unshadowed[i]);
    place.sum3(sums.shadowed, total.shadowed);
    place.sum3(sums.unshadowed_samples, total.unshadowed_samples);
    place.sum3(surface.emission, film.emission);
    place.sum3(surface.base_color, film.base_color);
    place.sum(surface.roughness, film.roughness);
    place.sum(surface.metallic, film.metallic);
    place.coverage(surface.depth, film.coverage);

    place.once(surface.depth, film.depth);
    place.once3(surface.normal, film.normal);
    place.once3(surface.geometric_normal, film.geometric_normal);
    place.once3(surface.position, film.position);
    place.once(surface.motion_x, film.motion_x);
    place.once(surface.motion_y, film.motion_y);
    place.once(surface.instance, film.instance);
    place.once(surface.triangle, film.triangle);
    place.once(surface.material, film.material);
}

void scale_to_means(int passes, int y0, int y1, Film& film) {
    const float factor = 1.0f / static_cast<float>(passes);
    const auto scale3 = [&](Plane3<float>& planes) {
        for (Plane<float>& plane : planes) scale(plane, factor, y0, y1);
    };
    for (Term& term : film.terms)
        for (Plane3<float>* sum : {&term.unshadowed, &term.shadowed, &term.unshadowed_samples})
            scale3(*sum);
    scale3(film.emission);
    scale3(film.base_color);
    for (Plane<float>* plane : {&film.roughness, &film.metallic, &film.coverage})
        scale(*plane, factor, y0, y1);
}

}  // namespace penumbra::renderer
