#!/bin/sh
# GNU parallel: parts on this machine, or on those named with --sshlogin (all have to see the folders).
#
#   parallel.sh MESHES OUTDIR PARTS [OPTIONS OF parallel...]
#
# A part that is killed is started again, up to three times, and goes on where it stopped. Exit code 1 is not a failure:
# all meshes of the part have been worked on, and results.csv says which are not embedded.
set -e
meshes=$1 out=$2 parts=$3
shift 3
parallel --retries 3 "$@" "unsnarl batch {2} -o {3} --shard {1}/$parts --jobs 1 --quiet || test \$? -eq 1" \
  ::: $(seq 0 $((parts - 1))) ::: "$meshes" ::: "$out"
unsnarl batch "$meshes" -o "$out" --summary
