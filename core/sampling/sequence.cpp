#include "core/sampling/sequence.h"

namespace penumbra {

Sequence make_sequence(const FrameContext& frame, std::uint32_t dimension, int samples) {
    std::uint32_t key = hash_pair(frame.seed, static_cast<std::uint32_t>(frame.frame));
    key = hash_pair(key, static_cast<std::uint32_t>(frame.pass));
    key = hash_pair(key, dimension);
    Sequence sequence;
    sequence.shuffle_seed = hash_pair(key, 1);
    sequence.scramble_seed_x = hash_pair(key, 2);
    sequence.scramble_seed_y = hash_pair(key, 3);
    sequence.sample_bits = std::bit_width(static_cast<unsigned>(samples - 1));
    return sequence;
}

}  // namespace penumbra
