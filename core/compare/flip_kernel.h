#pragma once

// Row kernels of FLIP; counts are rounded up to whole vectors.

namespace penumbra::compare {

// The filtered values of one image's row: Y, Cx, Cz; edges and points along x and y.
struct FlipFeatures {
    const float* colour[3];
    const float* edge[2];
    const float* point[2];
};

}  // namespace penumbra::compare

namespace penumbra::avx2 {
void flip_opponent_row(const float* const linear[3], float* const ycxcz[3], int count);
void flip_error_row(const compare::FlipFeatures& ref, const compare::FlipFeatures& test,
                    float largest_distance, float* errors, int count);
void flip_tone_row(const float* scene, float scale, float* display, int count);
}  // namespace penumbra::avx2

namespace penumbra::avx512 {
void flip_opponent_row(const float* const linear[3], float* const ycxcz[3], int count);
void flip_error_row(const compare::FlipFeatures& ref, const compare::FlipFeatures& test,
                    float largest_distance, float* errors, int count);
void flip_tone_row(const float* scene, float scale, float* display, int count);
}  // namespace penumbra::avx512
