#include "apps/page/html.h"

#include <fmt/format.h>

#include <cstdint>
#include <span>

namespace penumbra::page {
namespace {

std::string base64(std::span<const std::uint8_t> bytes) {
    constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::string_view policy(Content content) {
    return content == Content::kStill
               ? "style-src 'unsafe-inline'"
               : "img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";
}

}  // namespace

std::string html_data_uri(const image::Picture& picture) {
    return "data:image/png;base64," + base64(image::encode_png(picture));
}

std::string html_escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string html_begin(std::string_view title, Content content, std::string_view style) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; {1}\">\n"
        "<meta name=\"viewport\" content=\"width=device-width\"><title>{0}</title>\n"
        "<style>\n{2}</style></head>\n<body><h1>{0}</h1>\n",
        html_escaped(title), policy(content), style);
}

}  // namespace penumbra::page
