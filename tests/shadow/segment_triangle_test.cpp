#include "shadow/segment_triangle.h"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <random>

#include "core/parallel/arena.h"

namespace penumbra::shadow {
namespace {

__extension__ using Wide = __int128;

struct IntVector {
    std::int64_t x, y, z;
    friend IntVector operator-(const IntVector& a, const IntVector& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
};

Wide determinant(const IntVector& a, const IntVector& b, const IntVector& c) {
    return a.x * (Wide{b.y} * c.z - Wide{b.z} * c.y) + a.y * (Wide{b.z} * c.x - Wide{b.x} * c.z) +
           a.z * (Wide{b.x} * c.y - Wide{b.y} * c.x);
}

// A second implementation in integers; the segment ends at origin + direction * far / 4.
bool meets_in_integers(const IntVector& origin, const IntVector& direction, int far_quarters,
                       const std::array<IntVector, 3>& triangle) {
    const IntVector a = triangle[0] - origin, b = triangle[1] - origin, c = triangle[2] - origin;
    const Wide u = determinant(direction, b, c), v = determinant(direction, c, a),
               w = determinant(direction, a, b);
    Wide facing = u + v + w, plane = determinant(a, b, c);
    const bool all_up = u >= 0 && v >= 0 && w >= 0, all_down = u <= 0 && v <= 0 && w <= 0;
    if (facing == 0 || (!all_up && !all_down)) return false;
    if (facing < 0) {
        facing = -facing;
        plane = -plane;
    }
    return plane >= 0 && 4 * plane <= far_quarters * facing;
}

Vec3f to_float(const IntVector& v, float scale) {
    return Vec3f{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)} * scale;
}

class Random {
  public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}
    float real(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(engine_);
    }
    int integer(int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(engine_);
    }
    IntVector vector(int range) {
        const int x = integer(-range, range);
        const int y = integer(-range, range);
        const int z = integer(-range, range);
        return {x, y, z};
    }
    Vec3f vector(float low, float high) {
        const float x = real(low, high);
        const float y = real(low, high);
        const float z = real(low, high);
        return {x, y, z};
    }

  private:
    std::mt19937 engine_;
};

ShearedSegment<float> sheared_segment(const Segment& s, int axis) {
    const Vec3f d = permuted(s.direction, axis);
    const float a = s.near_limit * d.z, b = s.far_limit * d.z;
    return {permuted(s.origin, axis), d.x / d.z, d.y / d.z, simd::min(a, b), simd::max(a, b)};
}

}  // namespace

TEST_CASE("sums of products keep what rounding would lose") {
    ExactSum sum;
    sum.add(1e300);
    sum.add_product(0x1p-300, 0x1p-200);
    sum.add(-1e300);
    CHECK(sum.sign() == 1);
    sum.add_product(-0x1p-300, 0x1p-200);
    CHECK(sum.sign() == 0);
    sum.add_product(1 + 0x1p-52, 1 + 0x1p-52, -1.0);
    sum.add(1 + 0x1p-51);
    CHECK(sum.sign() == -1);  // by 2^-104
}

TEST_CASE("segments and triangles on small grids meet as integers say, degenerate ones included") {
    const parallel::FlushDenormals flush;
    Random random(1);
    int met = 0, wrong = 0;
    for (int i = 0; i < 400000; ++i) {
        const int range = 1 + i % 4;
        const IntVector origin = random.vector(range), direction = random.vector(range);
        const std::array<IntVector, 3> triangle = {random.vector(range), random.vector(range),
                                                   random.vector(range)};
        const int far_quarters = random.integer(1, 8);
        const float scale = i % 2 != 0 ? 1.0f : 0x1p-20f;
        const Vec3f vertices[3] = {to_float(triangle[0], scale), to_float(triangle[1], scale),
                                   to_float(triangle[2], scale)};
        const Segment segment = {to_float(origin, scale), to_float(direction, scale), 0,
                                 0.25f * static_cast<float>(far_quarters)};
        const bool expected = meets_in_integers(origin, direction, far_quarters, triangle);
        wrong += meets(segment, vertices) != expected;
        wrong += meets_exactly(segment, vertices) != expected;
        met += expected;
    }
    CHECK(wrong == 0);
    CHECK(met > 10000);
}

TEST_CASE("far from the origin, large integers agree too") {
    const parallel::FlushDenormals flush;
    Random random(2);
    int met = 0, wrong = 0;
    for (int i = 0; i < 100000; ++i) {
        // Up to 2^24, all of them floats: vertices close together and rays close to their edges.
        const IntVector base = random.vector(1 << 23);
        const auto near_base = [&](int range) {
            const IntVector v = random.vector(range);
            return IntVector{base.x + v.x, base.y + v.y, base.z + v.z};
        };
        const std::array<IntVector, 3> triangle = {near_base(40), near_base(40), near_base(40)};
        const IntVector origin = random.vector(1 << 22);
        const IntVector& aim = triangle[static_cast<std::size_t>(i % 3)];
        const IntVector jitter = random.vector(i % 5);
        const IntVector direction =
            IntVector{aim.x + jitter.x, aim.y + jitter.y, aim.z + jitter.z} - origin;
        const Vec3f vertices[3] = {to_float(triangle[0], 1), to_float(triangle[1], 1),
                                   to_float(triangle[2], 1)};
        const Segment segment = {to_float(origin, 1), to_float(direction, 1), 0, 1.25f};
        const bool expected = meets_in_integers(origin, direction, 5, triangle);
        wrong += meets(segment, vertices) != expected;
        met += expected;
    }
    CHECK(wrong == 0);
    CHECK(met > 10000);
}

TEST_CASE("a first look in float never contradicts the exact answer, and seldom leaves it open") {
    const parallel::FlushDenormals flush;
    Random random(3);
    int contradictions = 0, open = 0, met = 0;
    constexpr int kTrials = 400000;
    for (int i = 0; i < kTrials; ++i) {
        const Vec3f center = random.vector(-1, 1) * (i % 3 == 0 ? 1e4f : 1.0f);
        const float size = i % 2 != 0 ? 1.0f : 1e-3f;
        Vec3f vertices[3] = {center + random.vector(-size, size),
                             center + random.vector(-size, size),
                             center + random.vector(-size, size)};
        if (i % 7 == 0)
            vertices[2] = vertices[1] + (vertices[2] - vertices[1]) * 1e-5f;  // a sliver
        const float along = random.real(0, 1);
        Vec3f aim = vertices[0] + (vertices[1] - vertices[0]) * along;  // on an edge, rounded
        if (i % 4 != 0) aim = aim + random.vector(-size, size);
        const Vec3f origin = aim + random.vector(-3, 3);
        const Segment segment = {origin, aim - origin, 0, random.real(0.5f, 1.5f)};
        const int axis = dominant_axis(segment.direction);
        const Vec3f turned[3] = {permuted(vertices[0], axis), permuted(vertices[1], axis),
                                 permuted(vertices[2], axis)};
        const Verdict<float> look = first_look(sheared_segment(segment, axis), turned);
        const bool exact = meets_exactly(segment, vertices);
        contradictions += look.meets && look.misses;
        contradictions += (look.meets && !exact) || (look.misses && exact);
        contradictions += meets(segment, vertices) != exact;
        open += !look.meets && !look.misses;
        met += exact;
    }
    CHECK(contradictions == 0);
    MESSAGE("open after a look in float: " << 100.0 * open / kTrials << " %");
    CHECK(open < kTrials / 2);
    CHECK(met > kTrials / 20);
}

TEST_CASE("which vertex is the first changes no answer, nor does the triangle's side") {
    const parallel::FlushDenormals flush;
    Random random(4);
    int different = 0;
    for (int i = 0; i < 100000; ++i) {
        const Vec3f a = random.vector(-1, 1), b = random.vector(-1, 1), c = random.vector(-1, 1);
        const Vec3f origin = random.vector(-2, 2);
        const Vec3f aim = a + (b - a) * random.real(0, 1);
        const Segment segment = {origin, aim - origin, 0, random.real(0.9f, 1.1f)};
        const Vec3f orders[6][3] = {{a, b, c}, {b, c, a}, {c, a, b},
                                    {a, c, b}, {c, b, a}, {b, a, c}};
        for (const auto& order : orders)
            different += meets(segment, order) != meets(segment, orders[0]);
    }
    CHECK(different == 0);
}

TEST_CASE("segments without a direction or with one that is no number meet nothing") {
    const Vec3f vertices[3] = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_FALSE(meets({{0, 0, 0}, {0, 0, 0}, 0, 1}, vertices));
    CHECK_FALSE(meets({{0, 0, -1}, {nan, nan, nan}, 0, 2}, vertices));
    CHECK(meets({{0, 0, -1}, {0, 0, 1}, 0, 1}, vertices));  // both ends belong to the segment
    CHECK(meets({{0, 0, 0}, {0, 0, 1}, 0, 1}, vertices));
    CHECK_FALSE(meets({{0, 0, -1}, {0, 0, 1}, 0, 0x1.fffffep-1f}, vertices));
    CHECK_FALSE(meets({{-2, 0, 0}, {1, 0, 0}, 0, 9}, vertices));  // seen edge-on
}

}  // namespace penumbra::shadow
