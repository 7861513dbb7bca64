#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Opens lcm-spy on one of Comptonaut's buses with Comptonaut's message types. Debian's own launcher fails on Java 17.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

usage() {
  cat <<TXT
Usage: scripts/lcm-spy.sh [--lcm-url URL] [--build DIR] [--print]
  --lcm-url URL   the bus to look at  (udpm://239.255.76.67:7667?ttl=0)
  --build DIR     where the message types are built  (build)
  --print         print the command instead of running it
Needs a Java that can open windows (Debian: openjdk-17-jre).
TXT
}

url=udpm://239.255.76.67:7667?ttl=0
build=${COMPTONAUT_BUILD_DIR:-build}
run=(exec)
while [ $# -gt 0 ]; do
  case $1 in
    --help | -h) usage; exit 0 ;;
    --print) run=(echo); shift; continue ;;
    --lcm-url) url=${2-} ;;
    --build) build=${2-} ;;
    *) echo "lcm-spy.sh: unknown option $1" >&2; usage >&2; exit 1 ;;
  esac
  shift 2 || { echo "lcm-spy.sh: $1 needs a value" >&2; exit 1; }
done

[ -f "$build/CMakeCache.txt" ] || cmake -S . -B "$build" -G Ninja > /dev/null
cmake --build "$build" --target lcm-spy-types > /dev/null
export LCM_DEFAULT_URL=$url
java=/usr/share/java
"${run[@]}" java -Djava.net.preferIPv4Stack=true -cp "$build/comptonaut-types.jar:$java/lcm.jar:$java/jchart2d.jar" lcm.spy.Spy
