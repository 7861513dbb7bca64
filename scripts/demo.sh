#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# From a fresh clone to a mission's report: installs what is missing, builds, and flies the published scenario with
# three simulated drones through the daemons that fly on real ones. Arguments go to scripts/simulate.sh.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

case " $* " in *" --help "* | *" -h "*) exec scripts/simulate.sh --help ;; esac

show() { # the last line of what comes in, written over; nothing where nobody watches
  if [ -t 1 ]; then
    awk '{ printf "\r\033[K%s", substr($0, 1, 100); fflush() } END { printf "\r\033[K" }'
  else
    cat > /dev/null
  fi
}

mkdir -p run
echo "Building, the first time for some minutes (all of it in run/build.log)"
if ! scripts/build.sh 2>&1 | tee run/build.log | show; then
  tail -n 30 run/build.log >&2
  echo "demo.sh: the build failed, see run/build.log" >&2
  exit 1
fi
exec scripts/simulate.sh "$@"
