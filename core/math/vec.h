#pragma once

#include "core/simd/lanes.h"

// Vectors over the lane type. F is float, double or simd::Float; members are planes of lanes.

namespace penumbra {

template <class F>
struct Vec2 {
    F x, y;
    friend Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
    friend Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
    friend Vec2 operator*(Vec2 a, F s) { return {a.x * s, a.y * s}; }
    friend Vec2 operator*(F s, Vec2 a) { return a * s; }
};

template <class F>
struct Vec3 {
    F x, y, z;

    friend Vec3 operator+(const Vec3& a, const Vec3& b) {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    friend Vec3 operator-(const Vec3& a, const Vec3& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend Vec3 operator*(const Vec3& a, const Vec3& b) {
        return {a.x * b.x, a.y * b.y, a.z * b.z};
    }
    friend Vec3 operator/(const Vec3& a, const Vec3& b) {
        return {a.x / b.x, a.y / b.y, a.z / b.z};
    }
    friend Vec3 operator*(const Vec3& a, F s) { return {a.x * s, a.y * s, a.z * s}; }
    friend Vec3 operator*(F s, const Vec3& a) { return a * s; }
    friend Vec3 operator/(const Vec3& a, F s) { return {a.x / s, a.y / s, a.z / s}; }
    friend Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
    Vec3& operator+=(const Vec3& b) { return *this = *this + b; }
    Vec3& operator-=(const Vec3& b) { return *this = *this - b; }
    Vec3& operator*=(F s) { return *this = *this * s; }
};

using Vec2f = Vec2<float>;
using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <class F>
F dot(const Vec3<F>& a, const Vec3<F>& b) {
    return simd::fma(a.x, b.x, simd::fma(a.y, b.y, a.z * b.z));
}

template <class F>
Vec3<F> cross(const Vec3<F>& a, const Vec3<F>& b) {
    return {simd::fma(a.y, b.z, -(a.z * b.y)), simd::fma(a.z, b.x, -(a.x * b.z)),
            simd::fma(a.x, b.y, -(a.y * b.x))};
}

template <class F>
F length_squared(const Vec3<F>& a) {
    return dot(a, a);
}

template <class F>
F length(const Vec3<F>& a) {
    return simd::sqrt(dot(a, a));
}

// Zero and non-finite vectors give NaN: callers mask such lanes.
template <class F>
Vec3<F> normalize(const Vec3<F>& a) {
    return a * (F(1) / length(a));
}

// a + s * b, fused.
template <class F>
Vec3<F> fma(const Vec3<F>& b, std::type_identity_t<F> s, const Vec3<F>& a) {
    return {simd::fma(b.x, s, a.x), simd::fma(b.y, s, a.y), simd::fma(b.z, s, a.z)};
}

template <class F>
Vec3<F> select(const simd::MaskOf<F>& m, const Vec3<F>& a, const Vec3<F>& b) {
    return {simd::select(m, a.x, b.x), simd::select(m, a.y, b.y), simd::select(m, a.z, b.z)};
}

// The same value in every lane.
template <class F>
Vec3<F> broadcast(const Vec3f& a) {
    return {F(a.x), F(a.y), F(a.z)};
}

// Rec. 709 luminance of a linear colour.
template <class F>
F luminance(const Vec3<F>& rgb) {
    return simd::fma(F(0.2126f), rgb.x, simd::fma(F(0.7152f), rgb.y, F(0.0722f) * rgb.z));
}

}  // namespace penumbra
