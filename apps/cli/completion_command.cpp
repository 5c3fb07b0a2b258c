#include "apps/cli/completion_command.h"

#include <memory>

#include "apps/cli/command_table.h"
#include "apps/cli/completion.h"
#include "apps/cli/manual_page.h"
#include "apps/cli/say.h"

namespace penumbra::cli {

void add_completion_command(CLI::App& app) {
    auto shell = std::make_shared<std::string>();
    CLI::App* command =
        app.add_subcommand("completion", "Print the script that completes penumbra in a shell");
    command->add_option("SHELL", *shell, "The shell")
        ->check(CLI::IsMember(std::vector<std::string>{"bash", "zsh"}))
        ->required();
    command->footer(
        "An installation holds both scripts already. To use one without it:\n"
        "  source <(penumbra completion bash)\n"
        "  penumbra completion zsh > FOLDER/_penumbra     a folder of $fpath");
    command->callback([&app, shell] {
        const CommandEntry program = describe(app);
        say(stdout, "{}", *shell == "bash" ? bash_completion(program) : zsh_completion(program));
    });
}

void add_manual_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("manual", "Print the manual page, for man");
    command->footer(
        "An installation holds the page already: man penumbra. To read it without one:\n"
        "  man <(penumbra manual)");
    command->callback([&app] { say(stdout, "{}", manual_page(describe(app), PENUMBRA_VERSION)); });
}

}  // namespace penumbra::cli
