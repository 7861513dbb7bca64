#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# Makes all response tables that ship again, some 6 minutes on two free cores: scripts/response-tables.sh [PROGRAM [NUCLIDE ...]]
set -e
cd "$(dirname "$0")/.."
program=${1:-build/bin/comptonaut}
[ $# -gt 0 ] && shift

make_table() {  # file, options
  file=$1
  shift
  case " $wanted " in *" $file "*) ;; *) return 0 ;; esac
  "$program" response --nuclide "config/nuclides/$folder$file.yaml" --photons 20000000 --single-rel-sigma 0.0095 --pair-rel-sigma 0.0285 "$@" --out "config/response/$file.csv"
}
cones() { echo "--cones config/response/$1-cones.csv --angles config/response/$1-angles.csv"; }

wanted=${*:-cs-137 ir-192 co-60 ba-133 i-131 am-241 ir-192-468 co-60-1332 co-60-1332-in-cs-137}
folder=
make_table cs-137 --thinning 4 $(cones cs-137) --picture config/response/cs-137-angles.svg
make_table ir-192 --thinning 2 $(cones ir-192)
make_table co-60 --thinning 8 $(cones co-60)
make_table am-241 --thinning 8
make_table ba-133 --thinning 4 $(cones ba-133)
make_table i-131 --thinning 4 $(cones i-131)
make_table ir-192-468 --thinning 2 $(cones ir-192-468)
make_table co-60-1332 --thinning 2 $(cones co-60-1332)
folder=down-scatter/  # what a line leaves in the channel of a lower one
make_table co-60-1332-in-cs-137 --thinning 1 $(cones co-60-1332-in-cs-137)
