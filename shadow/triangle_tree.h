#pragma once

#include <cstdint>

#include "core/scene/cutout.h"

// A tree of boxes over triangles, as the kernels read it.

namespace penumbra::shadow {

inline constexpr int kTreeWidth = 8;  // children of a node, triangles of a leaf: lanes of AVX2

// What a cutout triangle needs beside its place in a leaf.
struct CutoutTriangle {
    Vec3f positions[3];
    Vec2f uvs[3];
    const CutoutMap* map;
};

struct alignas(64) TreeLeaf {
    float vertices[3][3][kTreeWidth];  // [vertex][axis]; lanes without a triangle repeat the first
    const CutoutTriangle* cutouts[kTreeWidth];  // null: opaque
    int count;
    bool has_cutouts;
};

struct TreeNode;

// A pointer to a node, to a leaf (odd), or null: TreeReference{}. Without braces it is anything, so
// that stacks of them cost nothing to make.
class TreeReference {
  public:
    TreeReference() = default;
    explicit TreeReference(const TreeNode* node) : at_(reinterpret_cast<const char*>(node)) {}
    explicit TreeReference(const TreeLeaf* leaf) : at_(reinterpret_cast<const char*>(leaf) + 1) {}
    [[nodiscard]] bool is_leaf() const { return (reinterpret_cast<std::uintptr_t>(at_) & 1) != 0; }
    [[nodiscard]] bool is_null() const { return at_ == nullptr; }
    [[nodiscard]] const TreeNode& node() const { return *reinterpret_cast<const TreeNode*>(at_); }
    [[nodiscard]] const TreeLeaf& leaf() const {
        return *reinterpret_cast<const TreeLeaf*>(at_ - 1);
    }

  private:
    const char* at_;
};

struct alignas(64) TreeNode {
    float bounds[2][3][kTreeWidth];  // [lower, upper][axis]; children that are not there: empty
    TreeReference children[kTreeWidth];
};

inline constexpr int kMaxTreeDepth = 64;

}  // namespace penumbra::shadow
