#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Flies one simulated mission with the real daemons, each drone and the ground station on a loopback bus of its own,
# records the ground station's bus and makes a report of it. Needs a finished build.
set -euo pipefail
here=$(cd "$(dirname "$(readlink -f "$0")")/.." && pwd)

usage() {
  cat <<TXT
Usage: scripts/simulate.sh [options]
  --scenario FILE    what to fly           (config/scenarios/werner2024-sim.yaml)
  --seed N           of sources and noise  (1)
  --out DIR          log, report and the daemons' output  (run/<date>-<time>)
  --port P           first of the UDP and TCP ports used, P .. P + 40  (7700)
  --config DIR       configuration of the daemons  (config)
  --build DIR        where the programs are  (build)
TXT
}

scenario=$here/config/scenarios/werner2024-sim.yaml
seed=1
out=$here/run/$(date +%Y%m%d-%H%M%S)
port=7700
config=$here/config
build=${COMPTONAUT_BUILD_DIR:-$here/build}
refuse() { # WHAT: one clear line
  echo "simulate.sh: $1" >&2
  exit 1
}
while [ $# -gt 0 ]; do
  case $1 in
    --help | -h) usage; exit 0 ;;
    --*) [ $# -ge 2 ] || refuse "$1 needs a value (see --help)" ;;
  esac
  case $1 in
    --scenario) scenario=$2 ;;
    --seed) seed=$2 ;;
    --out) out=$2 ;;
    --port) port=$2 ;;
    --config) config=$2 ;;
    --build) build=$2 ;;
    *) refuse "unknown option '$1' (see --help)" ;;
  esac
  shift 2
done
[[ $port =~ ^[0-9]+$ ]] && [ "$port" -ge 1024 ] && [ "$port" -le 65495 ] || refuse "--port '$port': must be 1024 to 65495"
[ -x "$build/bin/comptonaut-simulator" ] || refuse "--build '$build' holds no finished build: run scripts/build.sh"

bin=$build/bin
bus() { echo "udpm://239.255.76.67:$((port + $1))?ttl=0&recv_buf_size=4194304"; }
team_bus="udpm://239.255.76.68:$((port + 10))?ttl=0"
log=$out/mission.lcm
mkdir -p "$out/output"

# From here on, whatever happens, nothing that was started stays.
declare -A name_of # pid -> name
watch=
stop_all() {
  local pid
  for pid in "${!name_of[@]}"; do kill -TERM "$pid" 2> /dev/null || true; done
  for _ in $(seq 50); do
    local alive=0
    for pid in "${!name_of[@]}"; do kill -0 "$pid" 2> /dev/null && alive=1; done
    [ $alive -eq 0 ] && break
    sleep 0.1
  done
  for pid in "${!name_of[@]}"; do kill -KILL "$pid" 2> /dev/null || true; done
  wait || true
  name_of=()
}
trap stop_all EXIT
trap 'exit 130' INT
trap 'exit 143' TERM

start() { # NAME COMMAND...: in the background, its output in a file of its own
  local name=$1 niceness=5
  shift
  [ "$name" = logger ] && niceness=0 # it drops what it has no time for, in silence: it goes before the others
  nice -n "$niceness" "$@" > "$out/output/$name.txt" 2>&1 &
  name_of[$!]=$name
}

end() { # NAME: ask it to end, wait, and insist on exit code 0
  local pid code=0
  for pid in "${!name_of[@]}"; do
    [ "${name_of[$pid]}" = "$1" ] || continue
    kill -TERM "$pid" 2> /dev/null || true
    wait "$pid" || code=$?
    unset "name_of[$pid]"
    [ $code -eq 0 ] || fail "$1" $code
  done
}

fail() { # NAME EXIT_CODE
  [ -z "$watch" ] || { kill -TERM "$watch" && wait "$watch"; } 2> /dev/null || true # its line would come behind
  echo "simulate.sh: $1 ended with exit code $2; its last words ($out/output/$1.txt):" >&2
  tail -n 5 "$out/output/$1.txt" >&2
  [ -s "$out/output/$1.txt" ] || echo "(none)" >&2
  exit 1
}

mavs=$("$bin/comptonaut" scenario "$scenario" --coordinator "$config/coordinator.yaml" --out "$out/coordinator.yaml" \
  --pose-bridge "$config/pose-bridge.yaml" --pose-bridge-out "$out/pose-bridge.yaml" \
  --mapper "$config/mapper.yaml" --mapper-out "$out/mapper.yaml")

start logger lcm-logger --quiet --force --lcm-url "$(bus 0)" "$log"
start coordinator "$bin/comptonaut-coordinator" --config "$out/coordinator.yaml" --lcm-url "$(bus 0)"
start team-link-0 "$bin/comptonaut-team-link" --config "$config/team-link.yaml" --mav 0 --lcm-url "$(bus 0)" --team-url "$team_bus"
for mav in $(seq "$mavs"); do
  common=(--mav "$mav" --lcm-url "$(bus "$mav")")
  start "team-link-$mav" "$bin/comptonaut-team-link" --config "$config/team-link.yaml" "${common[@]}" --team-url "$team_bus"
  start "mapper-$mav" "$bin/comptonaut-mapper" --config "$out/mapper.yaml" "${common[@]}" --journal "$out/journal-$mav.lcm"
  start "pose-bridge-$mav" "$bin/comptonaut-pose-bridge" --config "$out/pose-bridge.yaml" "${common[@]}" --autopilot "udp:$((port + 30 + mav))"
  start "detector-reader-$mav" "$bin/comptonaut-detector-reader" --config "$config/detector-reader.yaml" "${common[@]}" --input "tcp:$((port + 20 + mav))"
done
start simulator "$bin/comptonaut-simulator" --config "$config/simulator.yaml" --lcm-url "$(bus 0)" --scenario "$scenario" \
  --seed "$seed" --detector-port "$((port + 20))" --autopilot-port "$((port + 30))" --bus-port "$port"
simulator=$!
"$bin/comptonaut" watch --lcm-url "$(bus 0)" &
watch=$!
name_of[$watch]=watch

# The mission ends when the simulator does; any other end before that is a failure.
while true; do
  code=0
  wait -n -p ended "${!name_of[@]}" || code=$?
  ended_name=${name_of[$ended]}
  unset "name_of[$ended]"
  [ $code -eq 0 ] || fail "$ended_name" $code
  [ "$ended" = "$simulator" ] && break
  [ "$ended_name" = watch ] || fail "$ended_name" $code
done

# Along the flow of data, so that each hands on what it still holds.
for mav in $(seq "$mavs"); do
  for daemon in detector-reader pose-bridge mapper team-link; do end "$daemon-$mav"; done
done
for daemon in team-link-0 coordinator watch logger; do end "$daemon"; done
trap - EXIT

"$bin/comptonaut" report "$log" --config "$out/coordinator.yaml" --out "$out/report.html"
