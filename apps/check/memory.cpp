#include "apps/check/memory.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "core/error.h"
#include "core/json/node.h"
#include "core/parallel/cgroup.h"
#include "core/parallel/proc_text.h"
#include "core/scene/input_files.h"

namespace penumbra::check {
namespace {

namespace fs = std::filesystem;

// Measured with all AOVs at 1920 x 1080: 200 bytes a pixel, and another film where several frames
// are rendered. A model's triangles, their tree and the reader take about 10 times its file.
constexpr std::uint64_t kBytesOfProgram = 48u << 20;
constexpr std::uint64_t kBytesPerPixel = 400;
constexpr std::uint64_t kBytesPerFileByte = 12;

struct Size {
    std::uint64_t width = 1920, height = 1080;
};

std::uint64_t bytes_of(const fs::path& file) {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    return error ? 0 : size;
}

// What the scene file says about sizes; it is read in earnest by the renderer.
void read_sizes(const fs::path& scene, Size& size, std::uint64_t& model_bytes) {
    InputFiles files;
    const json::Value value = json::parse(scene, files.read(scene, json::kMaxDocumentBytes));
    const json::Node document(scene, value, "the document");
    if (const auto film = document.find("film"))
        if (const auto list = film->find("size"); list && list->size() == 2)
            size = {static_cast<std::uint64_t>((*list)[0].number(json::kNonNegative)),
                    static_cast<std::uint64_t>((*list)[1].number(json::kNonNegative))};
    if (const auto models = document.find("models"))
        for (std::size_t i = 0; i < models->size(); ++i)
            model_bytes += bytes_of(scene.parent_path() / (*models)[i].require("file").text());
}

// "1920x1080"; unchanged where it is none.
void read_size(const std::string& text, Size& size) {
    Size given;
    const char* const end = text.data() + text.size();
    const auto [after_width, width_error] = std::from_chars(text.data(), end, given.width);
    if (width_error != std::errc{} || after_width == end) return;
    const auto [after_height, error] = std::from_chars(after_width + 1, end, given.height);
    if (error == std::errc{} && after_height == end) size = given;
}

// What could be had without swapping; a guess where the kernel does not say.
std::uint64_t bytes_of_machine() {
    const std::string text = parallel::read_text("/proc/meminfo");
    for (const std::string_view line : parallel::split_words(text, "\n")) {
        const auto words = parallel::split_words(line, " ");
        if (words.size() == 3 && words[0] == "MemAvailable:")
            return static_cast<std::uint64_t>(parallel::parse_integer(words[1]).value_or(0)) * 1024;
    }
    return std::uint64_t{1} << 32;
}

}  // namespace

std::uint64_t estimated_bytes(const Check& check, const CheckSettings& settings) {
    const fs::path& scene = settings.scene.empty() ? check.scene : settings.scene;
    Size size;
    std::uint64_t model_bytes = 0;
    if (scene.extension() == ".json") {
        try {
            read_sizes(scene, size, model_bytes);
        } catch (const std::runtime_error&) {
            // The renderer will say what is wrong with it.
        }
    } else {
        model_bytes = bytes_of(scene);
    }
    if (const auto option = settings.render.find("size"); option != settings.render.end())
        read_size(option->second, size);
    constexpr std::uint64_t kLargestSide = 16384;
    const std::uint64_t pixels =
        std::min(size.width, kLargestSide) * std::min(size.height, kLargestSide);
    return kBytesOfProgram + pixels * kBytesPerPixel + model_bytes * kBytesPerFileByte;
}

std::uint64_t available_bytes() {
    const std::uint64_t machine = bytes_of_machine();
    const auto cgroup = parallel::cgroup_memory_left(
        parallel::cgroup_folders(parallel::read_text("/proc/self/cgroup"),
                                 parallel::read_text("/proc/self/mountinfo"), "memory", "/"));
    return std::min(machine, cgroup.value_or(machine));
}

}  // namespace penumbra::check
