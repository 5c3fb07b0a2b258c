#include "apps/renderer/deposit.h"

#include <array>

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
    // What is made row by row, averaged or not.
    void rows(const TileResult& from, RowFormula formula, AovPasses passes,
              Plane<float>& to) const {
        if (!is_first_ && passes == AovPasses::kFirst) return;
        each_row(to, [&](int y, float* row) {
            if (is_first_) return formula(from, y, row);
            std::array<float, kTileSize> added;
            formula(from, y, added.data());
            for (std::size_t x = 0; x < added.size(); ++x) row[x] += added[x];
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

// Visits where a channel comes from.
struct Taking {
    const TileResult& from;
    const Place& place;
    AovPasses passes;
    AovPlane& to;

    void operator()(SurfaceNumbers of) const {
        const PlaneView<const float> numbers = of(from.surface);
        if (passes == AovPasses::kMean)
            place.sum(numbers, to.numbers);
        else
            place.once(numbers, to.numbers);
    }
    void operator()(SurfaceIds of) const { place.once(of(from.surface), to.ids); }
    void operator()(RowFormula formula) const { place.rows(from, formula, passes, to.numbers); }
    void operator()(FilmPlane) const {}
};

void take_aovs(const TileResult& from, const Place& place, Film& film) {
    for (const AovInfo& aov : aov_table()) {
        if (!film.wanted.contains(aov.aov)) continue;
        std::vector<AovPlane>& planes = film.taken[static_cast<std::size_t>(aov.aov)];
        for (std::size_t i = 0; i < planes.size(); ++i)
            std::visit(Taking{from, place, aov.passes, planes[i]}, aov.slots[i].source);
    }
}

}  // namespace

void deposit(const TileResult& from, Film& film) {
    const Place place(from.tile, from.pass, film);
    const ConstLightSumsView& sums = from.sums;
    Term& total = film.total();
    for (std::size_t i = 0; i < 3; ++i)
        place.sum_of(sums.unshadowed_diffuse[i], sums.unshadowed_glossy[i], total.unshadowed[i]);
    place.sum3(sums.shadowed, total.shadowed);
    place.sum3(sums.unshadowed_samples, total.unshadowed_samples);
    place.sum3(from.surface.emission, film.emission);
    place.once(from.surface.depth, film.depth);
    place.once3(from.surface.geometric_normal, film.geometric_normal);
    take_aovs(from, place, film);
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
    for (const AovInfo& aov : aov_table())
        if (aov.passes == AovPasses::kMean)
            for (AovPlane& plane : film.taken[static_cast<std::size_t>(aov.aov)])
                scale(plane.numbers, factor, y0, y1);
}

}  // namespace penumbra::renderer
