#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a fresh clone to a mission's report: installs what is missing, builds, and flies the published scenario with
# three simulated drones through the daemons that fly on real ones. Arguments go to scripts/simulate.sh.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

mkdir -p run
echo "Building (progress in run/build.log) ..."
if ! scripts/build.sh > run/build.log 2>&1; then
  tail -n 30 run/build.log >&2
  echo "demo.sh: the build failed, see run/build.log" >&2
  exit 1
fi
exec scripts/simulate.sh "$@"
