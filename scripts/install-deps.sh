#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs every Debian package that building, testing and running Comptonaut needs. The one place that names them.
set -euo pipefail

packages=(
  # build
  g++ cmake ninja-build
  # what the design stands on: messages, linear algebra, world model, collision, formatting, configuration
  liblcm-dev liblcm-bin libeigen3-dev liboctomap-dev libccd-dev libfmt-dev libyaml-cpp-dev
  libcli11-dev            # command lines
  libcairo2-dev           # pictures: the same drawing as PNG and as SVG, with text
  libpng-dev              # heightmaps are pictures of 8 or 16 bits
  nlohmann-json3-dev      # the data inside the report's page
  python-fisx-common      # NIST XCOM cross sections and fluorescence data, as text files
  python3                 # scripts/pixet-stream.py: the vendor's interface to the detector is Python
  liblcm-java libjchart2d-java openjdk-17-jdk-headless # message types for lcm-spy
  libgtest-dev libbenchmark-dev # tests and benchmarks
  clang                   # scripts/fuzz.sh: libFuzzer, which tests what reads bytes of others, comes with it
  chromium                # the browser that the report is tested in
  systemd                 # systemd-analyze, to verify the units
)

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi
echo "Installing: ${missing[*]}"
as_root=()
[ "$(id -u)" -eq 0 ] || as_root=(sudo)
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "${missing[@]}"
