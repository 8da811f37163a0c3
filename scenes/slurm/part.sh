#!/usr/bin/env bash
#SBATCH --job-name=pahrender-part
# One part of a picture, by samples:
#   sbatch --array=0-7 part.sh SCENE PICTURE SAMPLES 8 [options of pahrender]
# writes PICTURE.part-N.film. A part that is interrupted and queued again goes on.
set -euo pipefail
scene=$1 picture=$2 samples=$3 parts=$4 n=$SLURM_ARRAY_TASK_ID
shift 4
exec "${PAHRENDER:-pahrender}" "$scene" -o "$picture.part-$n.film" \
  --samples "$((samples * n / parts)):$((samples * (n + 1) / parts))" \
  --threads "${SLURM_CPUS_PER_TASK:-1}" --checkpoint 60 --resume "$@"
