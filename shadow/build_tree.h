#pragma once

#include <memory>
#include <span>

#include "core/parallel/arena.h"
#include "shadow/triangle_tree.h"

namespace penumbra::shadow {

struct TreeTriangle {
    Vec3f vertices[3];
    const CutoutTriangle* cutout = nullptr;  // null: opaque
};

// Builds trees with Embree's builder; nothing but their shape, which changes no result, is its.
class TreeBuilder {
  public:
    explicit TreeBuilder(const parallel::Arena& arena);
    ~TreeBuilder();

    // A built tree. Lives no longer than its builder.
    class Tree {
      public:
        Tree();
        ~Tree();
        Tree(Tree&&) noexcept;
        Tree& operator=(Tree&&) noexcept;
        [[nodiscard]] TreeReference root() const { return root_; }

      private:
        friend class TreeBuilder;
        struct Memory;
        std::unique_ptr<Memory> memory_;
        TreeReference root_{};
    };

    // Throws OutputError if memory is short.
    [[nodiscard]] Tree build(std::span<const TreeTriangle> triangles) const;

  private:
    struct Device;
    const parallel::Arena& arena_;
    std::unique_ptr<Device> device_;
};

}  // namespace penumbra::shadow
