#!/usr/bin/env bash
# The two commands of the README in a fresh clone, as a newcomer has it: what is not committed is not
# there, nothing is built. Not a ctest: it runs them all.
#
# usage: tests/e2e/fresh_clone.sh FOLDER     FOLDER must not exist; it is left for a look around
set -euo pipefail

source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
clone=${1:?usage: fresh_clone.sh FOLDER}
[ ! -e "$clone" ] || { echo "fresh_clone: $clone is there already" >&2; exit 2; }

git clone --quiet "$source" "$clone"
cd "$clone"
# A clone elsewhere has no data of tests beside it.
export CSGRUN_SHARED=${CSGRUN_SHARED:-$source/../shared}

./dev run examples/bracket.lua -o bracket.glb
[ "$(head -c 4 bracket.glb)" = glTF ] || { echo "fresh_clone: bracket.glb is no GLB" >&2; exit 1; }
rm bracket.glb
./dev test

left=$(git status --porcelain)
[ -z "$left" ] || { echo "fresh_clone: the tests left behind:" "$left" >&2; exit 1; }
echo "fresh_clone: both commands of the README work in $clone"
