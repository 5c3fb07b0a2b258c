#include "apps/renderer/frame_statistics.h"

namespace penumbra::renderer {

std::string_view name(Pass pass) {
    switch (pass) {
        case Pass::kEvaluate:
            return "evaluate";
        case Pass::kSetup:
            return "setup";
        case Pass::kRasterize:
            return "rasterize";
        case Pass::kResolve:
            return "resolve";
        case Pass::kShade:
            return "shade";
        case Pass::kRays:
            return "rays";
        case Pass::kTrace:
            return "trace";
        case Pass::kDeposit:
            return "deposit";
        case Pass::kNoise:
            return "noise";
        case Pass::kFilter:
            return "filter";
    }
    return "";
}

}  // namespace penumbra::renderer
