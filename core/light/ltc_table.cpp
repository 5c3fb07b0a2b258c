#include "core/light/ltc_table.h"

namespace penumbra {

// Whole rows are loaded at once, so they lie on the cache line's grid.
alignas(64) const float kLtcTable[] = {
#include "core/light/ltc_table_data.inc"
};

static_assert(sizeof(kLtcTable) ==
              sizeof(float) * kLtcRoughnessNodes * kLtcAngleNodes * kLtcRowFloats);

}  // namespace penumbra
