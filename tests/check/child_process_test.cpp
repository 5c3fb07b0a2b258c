#include "apps/check/child_process.h"

#include <doctest/doctest.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "apps/check/temporary_folder.h"
#include "core/error.h"
#include "tests/check/folder.h"

using namespace penumbra;
using check::ChildProcess;
using tests::Folder;

namespace {

ChildProcess::Ending ending_of(ChildProcess& child) {
    for (int i = 0; i < 5000; ++i) {
        if (const auto ending = child.poll()) return *ending;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    FAIL("it does not end");
    return {};
}

ChildProcess shell(const Folder& folder, const std::string& script) {
    return ChildProcess({"/bin/sh", "-c", script}, folder / "log");
}

}  // namespace

TEST_CASE("how a child ends is known, and what it said") {
    const Folder folder;
    ChildProcess child = shell(folder, "echo wrong >&2; echo right; exit 7");
    const auto ending = ending_of(child);
    CHECK(ending.exit_code == 7);
    CHECK(ending.signal == 0);
    std::ifstream log(folder / "log");
    CHECK(std::string{std::istreambuf_iterator<char>(log), {}} == "wrong\n");
}

TEST_CASE("a child that crashes is told apart") {
    const Folder folder;
    ChildProcess child = shell(folder, "kill -SEGV $$");
    CHECK(ending_of(child).signal == SIGSEGV);
}

TEST_CASE("a program that is not there ends with 127") {
    const Folder folder;
    ChildProcess child({folder / "nothing"}, folder / "log");
    CHECK(ending_of(child).exit_code == 127);
    CHECK_THROWS_AS(ChildProcess({"/bin/true"}, folder / "no/such/log"), OutputError);
}

TEST_CASE("killing a child ends its children too") {
    const Folder folder;
    {
        ChildProcess child = shell(folder, "(sleep 1; echo late >&2) & sleep 60");
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        CHECK_FALSE(child.poll());
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1200));
    CHECK(std::filesystem::file_size(folder / "log") == 0);
}

TEST_CASE("a temporary folder goes with all in it") {
    std::filesystem::path path;
    {
        const check::TemporaryFolder folder;
        path = folder.path();
        std::filesystem::create_directories(path / "a/b");
        CHECK(std::filesystem::is_directory(path / "a/b"));
    }
    CHECK_FALSE(std::filesystem::exists(path));
}
