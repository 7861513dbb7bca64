#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the fuzz targets of everything that reads bytes of others, and lets libFuzzer look for bytes that break them, so
# many seconds each (5 without an argument), from the inputs in tests/fuzz/corpus. What it finds beyond these it keeps
# in the build folder for the next time. Ends with 1 and says which input it was, where a target fails, takes more than
# 10 s for one input or more than 1 GB. Arguments: seconds, then targets if not all.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/.."

seconds=${1:-5}
shift || true
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=($(cd tests/fuzz/corpus && echo *))
build=${COMPTONAUT_FUZZ_BUILD_DIR:-build-fuzz}

cmake -S . -B "$build" -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCOMPTONAUT_FUZZ=ON > /dev/null
cmake --build "$build" --target fuzz_parsers fuzz_others > "$build/fuzz-build.log" 2>&1 || { tail -30 "$build/fuzz-build.log"; exit 1; }

failed=0
for target in "${targets[@]}"; do
  found=$build/fuzz-found/$target
  log=$build/fuzz-$target.log
  mkdir -p "$found"
  # tests/fuzz/targets.h lists the parsers' targets first.
  program=fuzz_others
  sed '/kOtherTargets/q' tests/fuzz/targets.h | grep -q "{\"$target\"" && program=fuzz_parsers
  if COMPTONAUT_FUZZ_TARGET=$target "$build/bin/$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=1024 \
      -max_len=8192 -use_value_profile=1 -print_final_stats=1 -artifact_prefix="$found/failed-" "$found" "tests/fuzz/corpus/$target" > "$log" 2>&1; then
    printf '%-12s %s executions, %s MB at most, nothing found\n' "$target" \
      "$(sed -n 's/stat::number_of_executed_units: *//p' "$log")" "$(sed -n 's/stat::peak_rss_mb: *//p' "$log")"
  else
    failed=1
    printf '%-12s FAILED, see %s:\n' "$target" "$log"
    grep -m 3 -E 'ERROR|what\(\)|Test unit written' "$log" || true
  fi
done
exit $failed
