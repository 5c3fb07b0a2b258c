#include "apps/bench/patience.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/bench/core_share.h"
#include "apps/bench/undisturbed.h"

namespace penumbra::bench {

Patience::Patience(const Settings& settings, const parallel::Arena& arena)
    : settings_(settings), arena_(arena) {}

int Patience::undisturbed() const {
    return static_cast<int>(std::count_if(shares_.begin(), shares_.end(), [&](double share) {
        return is_undisturbed(share, settings_.best_share);
    }));
}

bool Patience::wants_more() const {
    if (count() < settings_.repetitions) return true;
    return undisturbed() < settings_.repetitions && spent_ < settings_.seconds;
}

void Patience::wait(const std::atomic<bool>& cancelled) {
    const profile::Stopwatch waiting;
    while (!cancelled && spent_ + waiting.seconds() < settings_.seconds) {
        if (is_undisturbed(core_share(arena_), settings_.best_share)) break;
    }
    spent_ += waiting.seconds();
    repetition_.restart();
}

void Patience::add(double core_share) {
    settings_.best_share = std::max(settings_.best_share, core_share);
    shares_.push_back(core_share);
    if (count() > settings_.repetitions) spent_ += repetition_.seconds();
}

std::string Patience::progress() const {
    const int disturbed = count() - undisturbed();
    const std::string text = fmt::format("{} of {}", undisturbed() + 1, settings_.repetitions);
    return disturbed > 0 ? fmt::format("{}, {} more were disturbed", text, disturbed) : text;
}

}  // namespace penumbra::bench
