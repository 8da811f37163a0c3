#!/usr/bin/env bash
#SBATCH --job-name=pahrender-merge
# The picture of its parts: sbatch --dependency=afterok:JOB merge.sh PICTURE
set -euo pipefail
# The last part may end early without a gap. What was interrupted has its checkpoint still.
for checkpoint in "$1".part-*[0-9].film.film; do
  [[ -e $checkpoint ]] || continue
  n=${checkpoint##*.part-} n=${n%%.*}
  echo "part $n of $1 is not complete; --array=$n submits it alone" >&2
  exit 1
done
exec "${PAHRENDER:-pahrender}" merge "$1".part-*[0-9].film -o "$1"
