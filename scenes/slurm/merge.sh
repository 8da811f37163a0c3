#!/usr/bin/env bash
#SBATCH --job-name=pahrender-merge
# The picture of its parts: sbatch --dependency=afterok:JOB merge.sh PICTURE
set -euo pipefail
# Checkpoints end in .film.film.
exec "${PAHRENDER:-pahrender}" merge "$1".part-*[0-9].film -o "$1"
