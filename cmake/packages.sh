# Sourced by apps/demo.sh and tests/run.sh: installs the Debian packages that penumbra builds with,
# where they are missing. Usage: install_packages PACKAGE...

PENUMBRA_BUILD_PACKAGES=(
    build-essential cmake ninja-build pkg-config git
    libembree-dev libtbb-dev libopenexr-dev libimath-dev libtinyobjloader-dev libglm-dev libxsimd-dev
    libcli11-dev nlohmann-json3-dev libfmt-dev libxxhash-dev libstb-dev
    libdeflate-dev
)
PENUMBRA_TEST_PACKAGES=(
    doctest-dev libbenchmark-dev libbenchmark-tools glmark2-data clang-format clang-tidy
    python3 chromium chromium-driver zsh groff-base
)

install_packages() {
    local missing=()
    local package
    for package in "$@"; do
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -gt 0 ] || return 0
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        as_root=(sudo)
    fi
    echo "Installing: ${missing[*]}"
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -q -y --no-install-recommends "${missing[@]}"
}
