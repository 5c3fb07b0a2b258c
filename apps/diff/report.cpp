#include "apps/diff/report.h"

#include <algorithm>

namespace penumbra::diff {

std::string_view name(FailureKind kind) {
    constexpr std::string_view kNames[] = {
        "missing", "not-an-image", "unsupported", "mask",   "nothing-left", "incomplete",
        "damaged", "format",       "parts",       "size",   "window",       "channels",
        "type",    "non-finite",   "threshold",   "differs"};
    return kNames[static_cast<int>(kind)];
}

bool is_input_error(FailureKind kind) {
    return kind <= FailureKind::kNothing;
}

bool LayerReport::differs() const {
    const auto has_non_finite = [](const NonFinite& n) { return n.nan + n.infinite > 0; };
    return has_non_finite(reference) || has_non_finite(test) ||
           std::any_of(channels.begin(), channels.end(),
                       [](const ChannelReport& channel) { return channel.differing > 0; });
}

int PairReport::exit_code() const {
    if (failures.empty()) return 0;
    return std::any_of(failures.begin(), failures.end(),
                       [](const Failure& failure) { return is_input_error(failure.kind); })
               ? 2
               : 1;
}

}  // namespace penumbra::diff
