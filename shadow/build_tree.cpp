#include "shadow/build_tree.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <new>
#include <vector>

#include "core/error.h"
#include "shadow/embree_objects.h"

namespace penumbra::shadow {
namespace {

// Boxes are larger than their triangles by a unit in the last place and a little more: what
// occlude_kernel.cpp needs of directions with zeros and of coordinates near zero.
constexpr float kRelativePadding = 0x1p-23f;
constexpr float kPadding = 0x1p-90f;  // metres

// Triangles per task when boxes are made.
constexpr std::size_t kTrianglesPerTask = 1 << 14;

constexpr std::size_t kAlignment = 64;

void* allocate(RTCThreadLocalAllocator allocator, std::size_t bytes) {
    void* const memory = rtcThreadLocalAlloc(allocator, bytes, kAlignment);
    if (memory == nullptr) throw std::bad_alloc();
    return memory;
}

void* create_node(RTCThreadLocalAllocator allocator, unsigned /*children*/, void* /*user*/) {
    auto* const node = new (allocate(allocator, sizeof(TreeNode))) TreeNode;
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    std::fill_n(node->children, kTreeWidth, TreeReference{});
    std::fill_n(&node->bounds[0][0][0], 3 * kTreeWidth, kInfinity);
    std::fill_n(&node->bounds[1][0][0], 3 * kTreeWidth, -kInfinity);
    return node;
}

// Children are handed about as pointers whose lowest bit marks leaves.
static_assert(sizeof(TreeReference) == sizeof(void*));

void set_children(void* node, void** children, unsigned count, void* /*user*/) {
    auto& to = *static_cast<TreeNode*>(node);
    for (unsigned i = 0; i < count; ++i) to.children[i] = std::bit_cast<TreeReference>(children[i]);
}

void set_bounds(void* node, const RTCBounds** bounds, unsigned count, void* /*user*/) {
    auto& to = *static_cast<TreeNode*>(node);
    for (unsigned i = 0; i < count; ++i) {
        const RTCBounds& b = *bounds[i];
        const float values[2][3] = {{b.lower_x, b.lower_y, b.lower_z},
                                    {b.upper_x, b.upper_y, b.upper_z}};
        for (int side = 0; side < 2; ++side)
            for (int axis = 0; axis < 3; ++axis) to.bounds[side][axis][i] = values[side][axis];
    }
}

void* create_leaf(RTCThreadLocalAllocator allocator, const RTCBuildPrimitive* primitives,
                  std::size_t count, void* user) {
    const auto* const triangles = static_cast<const TreeTriangle*>(user);
    auto* const leaf = new (allocate(allocator, sizeof(TreeLeaf))) TreeLeaf;
    leaf->count = static_cast<int>(count);
    leaf->has_cutouts = false;
    for (std::size_t lane = 0; lane < kTreeWidth; ++lane) {
        const TreeTriangle& t = triangles[primitives[lane < count ? lane : 0].primID];
        for (int i = 0; i < 3; ++i) {
            leaf->vertices[i][0][lane] = t.vertices[i].x;
            leaf->vertices[i][1][lane] = t.vertices[i].y;
            leaf->vertices[i][2][lane] = t.vertices[i].z;
        }
        leaf->cutouts[lane] = t.cutout;
        leaf->has_cutouts |= t.cutout != nullptr;
    }
    return std::bit_cast<void*>(TreeReference(leaf));
}

float lower(float a, float b, float c) {
    const float low = std::min({a, b, c});
    return low - std::abs(low) * kRelativePadding - kPadding;
}

float upper(float a, float b, float c) {
    return -lower(-a, -b, -c);
}

RTCBuildPrimitive primitive(const TreeTriangle& t, unsigned index) {
    const auto& [a, b, c] = t.vertices;
    return {.lower_x = lower(a.x, b.x, c.x),
            .lower_y = lower(a.y, b.y, c.y),
            .lower_z = lower(a.z, b.z, c.z),
            .geomID = 0,
            .upper_x = upper(a.x, b.x, c.x),
            .upper_y = upper(a.y, b.y, c.y),
            .upper_z = upper(a.z, b.z, c.z),
            .primID = index};
}

std::vector<RTCBuildPrimitive> primitives(const parallel::Arena& arena,
                                          std::span<const TreeTriangle> triangles) {
    std::vector<RTCBuildPrimitive> result(triangles.size());
    const std::size_t tasks = (triangles.size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
    arena.for_each(static_cast<int>(tasks), [&](int task, int) {
        const std::size_t begin = static_cast<std::size_t>(task) * kTrianglesPerTask;
        const std::size_t end = std::min(begin + kTrianglesPerTask, triangles.size());
        for (std::size_t i = begin; i < end; ++i)
            result[i] = primitive(triangles[i], static_cast<unsigned>(i));
    });
    return result;
}

RTCBuildArguments build_arguments(RTCBVH tree, std::vector<RTCBuildPrimitive>& from,
                                  std::span<const TreeTriangle> triangles) {
    RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.buildQuality = RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = kTreeWidth;
    arguments.maxDepth = kMaxTreeDepth;
    arguments.sahBlockSize = kTreeWidth;
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = kTreeWidth;
    arguments.bvh = tree;
    arguments.primitives = from.data();
    arguments.primitiveCount = arguments.primitiveArrayCapacity = from.size();
    arguments.createNode = &create_node;
    arguments.setNodeChildren = &set_children;
    arguments.setNodeBounds = &set_bounds;
    arguments.createLeaf = &create_leaf;
    arguments.userPtr = const_cast<TreeTriangle*>(triangles.data());
    return arguments;
}

}  // namespace

struct TreeBuilder::Device {
    shadow::Device device = new_device(TraceIsa::kAuto);
};

struct TreeBuilder::Tree::Memory {
    RTCBVH nodes;
    explicit Memory(RTCDevice device) : nodes(rtcNewBVH(device)) {}
    ~Memory() { rtcReleaseBVH(nodes); }
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
};

TreeBuilder::Tree::Tree() = default;
TreeBuilder::Tree::~Tree() = default;
TreeBuilder::Tree::Tree(Tree&&) noexcept = default;
TreeBuilder::Tree& TreeBuilder::Tree::operator=(Tree&&) noexcept = default;

TreeBuilder::TreeBuilder(const parallel::Arena& arena)
    : arena_(arena), device_(std::make_unique<Device>()) {}
TreeBuilder::~TreeBuilder() = default;

TreeBuilder::Tree TreeBuilder::build(std::span<const TreeTriangle> triangles) const {
    Tree tree;
    if (triangles.empty()) return tree;
    tree.memory_ = std::make_unique<Tree::Memory>(device_->device.get());
    std::vector<RTCBuildPrimitive> from = primitives(arena_, triangles);
    const RTCBuildArguments arguments = build_arguments(tree.memory_->nodes, from, triangles);
    void* root = nullptr;
    arena_.run([&] { root = rtcBuildBVH(&arguments); });
    const RTCError error = rtcGetDeviceError(device_->device.get());
    if (root == nullptr || error != RTC_ERROR_NONE)
        throw OutputError(fmt::format("building the shadow rays' tree failed (Embree error {})",
                                      static_cast<int>(error)));
    tree.root_ = std::bit_cast<TreeReference>(root);
    return tree;
}

}  // namespace penumbra::shadow
