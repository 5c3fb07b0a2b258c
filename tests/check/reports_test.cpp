#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <memory>

#include "apps/check/accept_command.h"
#include "apps/check/junit.h"

using namespace penumbra;
using check::CheckOutcome;
using check::FrameOutcome;
using check::Verdict;

namespace {

// What a shell makes of a line, by its own printf: one word per line.
std::string words_of(const std::string& line) {
    const std::string command = "set -- " + line + "; printf '%s\\n' \"$@\"";
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::string text;
    for (int c = std::fgetc(pipe.get()); c != EOF; c = std::fgetc(pipe.get()))
        text += static_cast<char>(c);
    return text;
}

CheckOutcome outcome(const std::string& name, Verdict verdict) {
    CheckOutcome result{.check = {name, name + ".check.json", name + ".json"}};
    FrameOutcome frame{.golden = name + ".golden.exr", .verdict = verdict};
    frame.render_fitness = check::Fitness{};
    if (verdict == Verdict::kFailed) {
        frame.comparison.emplace();
        frame.comparison->failures.push_back({diff::FailureKind::kDiffers, "beauty", "R < G & B"});
    }
    result.frames.push_back(std::move(frame));
    return result;
}

CheckOutcome broken(const std::string& name, check::ErrorKind kind) {
    CheckOutcome result{.check = {name, "", name + ".json"}};
    result.error = check::Error{kind, "signal 11 \"SEGV\""};
    result.log = "line 1\nline 2\x1b[0m";
    return result;
}

const check::Invocation kInvocation{"./penumbra", {"goldens", "--filter=a b"}, {"--isa=avx2"}};

}  // namespace

TEST_CASE("any word survives the shell") {
    const std::vector<std::string> words = {"plain", "a b", "it's", "$HOME", "`ls`", "*", "a\\b",
                                            "\"",    "",    "-x",   "~",     "a;b",  "ä", "!!"};
    std::string expected;
    for (const std::string& word : words) expected += word + "\n";
    CHECK(words_of(check::shell_line(words)) == expected);
}

TEST_CASE("the accepting command names what failed and says no more than is needed") {
    const std::vector<CheckOutcome> one = {outcome("a", Verdict::kPassed),
                                           outcome("my b", Verdict::kFailed)};
    CHECK(check::accept_command(kInvocation, one) ==
          "./penumbra check --update --isa=avx2 'my b.check.json'");
    CHECK(check::accept_command(kInvocation, {outcome("a", Verdict::kMissing)}) ==
          "./penumbra check --bless-missing --isa=avx2 a.check.json");
    CHECK(check::accept_command(kInvocation, {outcome("a", Verdict::kPassed)}) == "");
    CHECK(check::accept_command(kInvocation, {broken("a", check::ErrorKind::kCrash)}) == "");
}

TEST_CASE("many failures are accepted by the run's own paths") {
    std::vector<CheckOutcome> many;
    for (int i = 0; i < 20; ++i) many.push_back(outcome(std::to_string(i), Verdict::kFailed));
    CHECK(check::accept_command(kInvocation, many) ==
          "./penumbra check --update --isa=avx2 goldens '--filter=a b'");
}

TEST_CASE("a render that cannot be a golden is not offered as one") {
    CheckOutcome black = outcome("a", Verdict::kFailed);
    black.frames[0].render_fitness->problem = "is black";
    CHECK(check::accept_command(kInvocation, black) == "");
    CheckOutcome twin = outcome("a", Verdict::kFailed);
    twin.frames[0].is_render_refused = true;
    CHECK(check::accept_command(kInvocation, twin) == "");
}

TEST_CASE("XML holds any text") {
    CHECK(check::xml_escaped("a < b & \"c\" > 'd'") ==
          "a &lt; b &amp; &quot;c&quot; &gt; &apos;d&apos;");
    CHECK(check::xml_escaped("1\n2\t3\r") == "1&#10;2&#9;3&#13;");
    CHECK(check::xml_escaped("ä€𝄞") == "ä€𝄞");
    const std::string replacement = "\xef\xbf\xbd";
    CHECK(check::xml_escaped(std::string("\0\x01\x1b", 3)) ==
          replacement + replacement + replacement);
    for (const char* broken : {"\x80", "\xff", "\xc0\xaf", "\xe2\x82", "\xed\xa0\x80",
                               "\xf8\x88\x80\x80\x80", "\xef\xbf\xbf", "\xf4\x90\x80\x80"}) {
        const std::string text = check::xml_escaped(broken);
        CHECK(text.starts_with(replacement));
        CHECK(text.size() % 3 == 0);
    }
}

TEST_CASE("JUnit counts failures apart from errors") {
    const std::string xml = check::junit_xml(
        {outcome("x/a", Verdict::kPassed), outcome("x/b", Verdict::kFailed),
         outcome("x/c", Verdict::kMissing), broken("x/d", check::ErrorKind::kCrash)},
        1.5);
    const auto holds = [&](const std::string& text) { return xml.find(text) != std::string::npos; };
    CHECK(holds("tests=\"4\" failures=\"2\" errors=\"1\" skipped=\"0\" time=\"1.500\""));
    CHECK(holds("<testcase classname=\"x\" name=\"b\" file=\"x/b.check.json\""));
    CHECK(holds("<failure type=\"failed\" message=\"differs: beauty: R &lt; G &amp; B\">"));
    CHECK(holds("<failure type=\"missing\""));
    CHECK(holds("<error type=\"crash\" message=\"crash: signal 11 &quot;SEGV&quot;\">"));
    CHECK_FALSE(holds("\x1b"));
}

TEST_CASE("the gravest outcome gives the exit code") {
    using check::ErrorKind;
    const CheckOutcome good = outcome("a", Verdict::kPassed), bad = outcome("b", Verdict::kFailed);
    CHECK(check::exit_code({good, outcome("c", Verdict::kUpdated)}) == 0);
    CHECK(check::exit_code({good, bad}) == 1);
    CHECK(check::exit_code({outcome("m", Verdict::kMissing)}) == 1);
    CHECK(check::exit_code({outcome("u", Verdict::kUnfit)}) == 1);
    CHECK(check::exit_code({bad, broken("s", ErrorKind::kScene)}) == 2);
    CHECK(check::exit_code({broken("s", ErrorKind::kSettings)}) == 2);
    CHECK(check::exit_code({broken("t", ErrorKind::kTimeout), broken("s", ErrorKind::kScene)}) ==
          3);
}
