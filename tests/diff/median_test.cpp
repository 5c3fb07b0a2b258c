#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "apps/diff/median.h"
#include "tests/core/image_testing.h"

namespace penumbra::diff {

TEST_CASE("the streaming median is that of sorting") {
    Random random(5);
    for (const std::size_t count : {1u, 2u, 3u, 1000u, 1001u}) {
        std::vector<float> values;
        for (std::size_t i = 0; i < count; ++i)
            values.push_back(std::ldexp(0.1f + static_cast<float>(random.below(1000)) / 1000,
                                        static_cast<int>(random.below(20)) - 10));
        StreamingMedian median;
        median.count_upper(values);
        median.choose_upper();
        median.count_lower(values);
        std::sort(values.begin(), values.end());
        CHECK(median.median() == values[count / 2]);
        CHECK(median.largest() == values.back());
    }
}

TEST_CASE("a picture that is mostly black has the median of the rest") {
    const std::vector<float> values = {0, 0, 0, 0, 1, 2, 3};
    StreamingMedian median;
    median.count_upper(values);
    median.choose_upper();
    median.count_lower(values);
    CHECK(median.median() == 2.0f);
}

}  // namespace penumbra::diff
