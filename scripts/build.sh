#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing and builds everything into build/ (or $COMPTONAUT_BUILD_DIR). Further arguments go to cmake.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

scripts/install-deps.sh
cmake -S . -B "${COMPTONAUT_BUILD_DIR:-build}" -G Ninja "$@"
cmake --build "${COMPTONAUT_BUILD_DIR:-build}"
