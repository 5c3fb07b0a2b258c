#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/cli/option_checks.h"
#include "apps/renderer/setting.h"
#include "core/simd/isa.h"

// Settings (renderer::each_setting) as options of a command. What is a number or a flag is written
// to its value when the line is parsed, anything else is kept as its text and read after that: then
// all options have been looked at, and the first one that is wrong is named.

namespace penumbra::cli {

using SettingTexts = std::map<std::string, std::string, std::less<>>;  // by name

// --isa, which several commands have and no pixel depends on.
[[nodiscard]] renderer::Choice<std::optional<simd::Isa>> isa_setting(std::string_view help);

// A visitor: declares each setting, with its value as the default. Texts and values are written to
// when the line is parsed.
class SettingDeclarer {
  public:
    SettingDeclarer(CLI::App& command, SettingTexts& texts) : command_(command), texts_(texts) {}

    template <class T>
    void operator()(const renderer::Choice<T>& setting, const T& value) const {
        if (setting.help.empty()) return;
        std::vector<std::string> words;
        for (const auto& [word, meaning] : setting.words) words.emplace_back(word);
        add_text(setting.name, setting.help, text_of(setting, value))->check(CLI::IsMember(words));
    }
    template <class T>
    void operator()(const renderer::Number& setting, T& value) const {
        if (setting.help.empty()) return;
        command_.add_option(option(setting.name), value, std::string(setting.help))
            ->check(in_range(setting.low, setting.high))
            ->capture_default_str();
    }
    void operator()(const renderer::Flag& setting, bool& value) const {
        if (setting.help.empty()) return;
        command_.add_flag(option(setting.name), value, std::string(setting.help));
    }
    template <class T>
    void operator()(const renderer::Written<T>& setting, const T& value) const {
        if (setting.help.empty()) return;
        CLI::Option* const added = add_text(setting.name, setting.help, text_of(setting, value));
        if (setting.words.empty())
            added->type_name(std::string(setting.value_name));
        else
            added->check(list_of(setting.words));
    }

  private:
    static std::string option(std::string_view name);
    CLI::Option* add_text(std::string_view name, std::string_view help, std::string value) const;

    CLI::App& command_;
    SettingTexts& texts_;
};

// A visitor: reads the texts of those settings that have one. Throws InputError.
class SettingReader {
  public:
    explicit SettingReader(const SettingTexts& texts) : texts_(texts) {}

    template <class Setting, class T>
    void operator()(const Setting& setting, T& value) const {
        if constexpr (requires { read_text(setting, std::string_view{}, value); })
            if (const auto text = texts_.find(setting.name); text != texts_.end())
                read_text(setting, text->second, value);
    }

  private:
    const SettingTexts& texts_;
};

}  // namespace penumbra::cli
