#!/usr/bin/env bash
#SBATCH --job-name=pahrender-frame
#SBATCH --requeue
# One frame of an animation:
#   sbatch --array=0-23 frame.sh SCENE frame_####.png [options of pahrender]
# Submitted again, it renders only what is not there yet.
set -euo pipefail
scene=$1 pictures=$2
shift 2
exec "${PAHRENDER:-pahrender}" "$scene" --frames "$SLURM_ARRAY_TASK_ID" -o "$pictures" \
  --threads "${SLURM_CPUS_PER_TASK:-1}" "$@"
