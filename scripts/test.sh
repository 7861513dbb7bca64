#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what is missing, builds and runs every test. Arguments go to ctest, for example: scripts/test.sh -R Mlem
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

scripts/build.sh
ctest --test-dir "${COMPTONAUT_BUILD_DIR:-build}" --output-on-failure --parallel 2 "$@"
