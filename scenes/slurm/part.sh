#!/usr/bin/env bash
#SBATCH --job-name=pahrender-part
#SBATCH --requeue
# One part of a picture, by samples:
#   sbatch --array=0-7 part.sh SCENE PICTURE SAMPLES 8 [options of pahrender]
# writes PICTURE.part-N.film. A part that is interrupted and queued again goes on.
set -euo pipefail
scene=$1 picture=$2 samples=$3 parts=$4 n=$SLURM_ARRAY_TASK_ID
shift 4
# More tasks than parts would add samples that were not asked for.
((n < parts)) || { echo "there is no part $n of $parts: the array is to be 0-$((parts - 1))" >&2; exit 2; }
range=$((samples * n / parts)):$((samples * (n + 1) / parts))
echo "part $n of $parts, samples $range; --array=$n submits it alone"
# By exec, so that --signal=B: comes to the program, which saves at SIGTERM.
exec "${PAHRENDER:-pahrender}" "$scene" -o "$picture.part-$n.film" --samples "$range" \
  --threads "${SLURM_CPUS_PER_TASK:-1}" --checkpoint 60 --resume "$@"
