#!/bin/sh
# A Slurm array: each task repairs its part of the meshes, as many at a time as it has processors.
#
#   parts=$(sbatch --parsable --array=0-99 slurm_array.sh MESHES OUTDIR)
#   sbatch --dependency=afterany:$parts --wrap "unsnarl batch MESHES -o OUTDIR --summary"
#
# MESHES is a folder or a list, OUTDIR a folder that all nodes see. A task that is killed is put into the queue again,
# up to three times, and goes on where it stopped; so does the same command after any other misfortune.
#SBATCH --job-name=unsnarl
#SBATCH --cpus-per-task=1
#SBATCH --requeue
#SBATCH --open-mode=append

unsnarl batch "$1" -o "$2" --jobs "${SLURM_CPUS_PER_TASK:-1}"
code=$?
# 0 and 1: all have been worked on; results.csv says which are not embedded. 2 and 3: the command is wrong.
case $code in 0|1) exit 0;; 2|3) exit $code;; esac
[ "${SLURM_RESTART_COUNT:-0}" -lt 3 ] && scontrol requeue "$SLURM_JOB_ID"
exit $code
