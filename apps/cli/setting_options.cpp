#include "apps/cli/setting_options.h"

#include <utility>

namespace penumbra::cli {

renderer::Choice<std::optional<simd::Isa>> isa_setting(std::string_view help) {
    return {"isa",
            {{"auto", std::nullopt}, {"avx2", simd::Isa::kAvx2}, {"avx512", simd::Isa::kAvx512}},
            help};
}

std::string SettingDeclarer::option(std::string_view name) {
    return "--" + std::string(name);
}

CLI::Option* SettingDeclarer::add_text(std::string_view name, std::string_view help,
                                       std::string value) const {
    std::string& text = texts_[std::string(name)] = std::move(value);
    return command_.add_option(option(name), text, std::string(help))->capture_default_str();
}

}  // namespace penumbra::cli
