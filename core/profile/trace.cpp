#include "core/profile/trace.h"

#include <fmt/format.h>

#include <iterator>

#include "core/profile/timeline.h"

// "Trace Event Format", Google, 2016: the JSON object format.

namespace penumbra::profile {
namespace {

using Text = fmt::memory_buffer;

template <class... Args>
void append(Text& text, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        if (static_cast<unsigned char>(c) < 0x20)
            result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
        else
            result += c;
    }
    return result;
}

const char* category(const Timeline::Entry& entry) {
    if (entry.is_idle) return "idle";
    switch (entry.slice.kind) {
        case Kind::kPhase:
            return "phase";
        case Kind::kLoop:
            return "loop";
        case Kind::kTask:
            return "task";
        case Kind::kPass:
            return "pass";
    }
    return "";
}

// Microseconds with all digits of the nanoseconds.
std::string microseconds(Nanoseconds time) {
    return fmt::format("{}.{:03}", time / 1000, time % 1000);
}

void append_arguments(Text& text, const Slice& slice) {
    if (!slice.first.key) return;
    append(text, R"(,"args":{{"{}":{})", slice.first.key, slice.first.value);
    for (const Argument& more : {slice.second, slice.third})
        if (more.key) append(text, R"(,"{}":{})", more.key, more.value);
    append(text, "}}");
}

void append_thread(Text& text, int thread, const Timeline& timeline) {
    append(
        text,
        ",\n"
        R"({{"name":"thread_name","ph":"M","pid":1,"tid":{0},"args":{{"name":"worker {0}"}}}},)"
        "\n"
        R"({{"name":"thread_sort_index","ph":"M","pid":1,"tid":{0},"args":{{"sort_index":{0}}}}})",
        thread);
    for (const Timeline::Entry& entry : timeline.entries) {
        append(text,
               ",\n"
               R"({{"name":"{}","cat":"{}","ph":"X","ts":{},"dur":{},"pid":1,"tid":{})",
               escaped(entry.slice.name), category(entry),
               microseconds(entry.slice.begin - timeline.begin),
               microseconds(entry.slice.end - entry.slice.begin), thread);
        append_arguments(text, entry.slice);
        append(text, "}}");
    }
}

}  // namespace

std::string chrome_trace(const Profile& profile, std::string_view title) {
    Text text;
    append(text,
           R"({{"displayTimeUnit":"ms","otherData":{{"title":"{0}","dropped_slices":{1}}},)"
           "\n"
           R"("traceEvents":[{{"name":"process_name","ph":"M","pid":1,"tid":0,)"
           R"("args":{{"name":"{0}"}}}})",
           escaped(title), profile.dropped());
    const std::vector<Timeline> threads = timelines(profile);
    for (std::size_t i = 0; i < threads.size(); ++i)
        append_thread(text, static_cast<int>(i), threads[i]);
    append(text, "\n]}}\n");
    return fmt::to_string(text);
}

}  // namespace penumbra::profile
