#!/usr/bin/env bash
# The documented commands for Slurm, with the job scripts of scenes/slurm, on a Slurm of one node: parts
# of a picture, one of which fails and is submitted again, their merging, frames, and a part that is
# interrupted.
set -euo pipefail
exec </dev/null

usage() {
  cat <<TXT
usage: tests/slurm/run.sh PAHRENDER

Starts munged, slurmctld and slurmd (Debian: slurmctld slurmd slurm-client munge) for itself alone,
in a temporary folder, and ends them. Exit codes: 0 all pictures are as they must be, 1 they are not,
77 it cannot be tried.
TXT
}

cannot() {
  echo "slurm: skipped: $*" >&2
  exit 77
}

if (($# != 1)) || [[ $1 == -* ]]; then
  usage
  [[ ${1:-} == -h || ${1:-} == --help ]] && exit 0
  exit 2
fi
PAHRENDER=$(realpath "$1")
export PAHRENDER
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
scenes=$source/scenes

PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch squeue sinfo scontrol; do
  command -v "$program" >/dev/null || cannot "there is no $program here"
done
((EUID == 0)) || cannot "slurmd starts jobs as root only"

folder=$(mktemp -d)
chmod 755 "$folder"
# Whatever Slurm this machine belongs to is left alone.
unset "${!SLURM_@}" "${!SBATCH_@}"
export SLURM_CONF=$folder/slurm.conf
daemons=()
clean_up() {
  local status=$?
  if ((status != 0)); then
    timeout 10 squeue 2>&1 || true
    tail -n 20 "$folder"/*.log "$folder"/*.out 2>/dev/null || true
  fi
  # Jobs would outlive slurmd.
  if timeout 10 squeue -h -t RUNNING,COMPLETING 2>/dev/null | grep -q .; then
    timeout 10 scancel --signal=KILL --full --user=root || true
    wait_for 10 "the jobs to end" is_idle || true
  fi
  for daemon in "${daemons[@]}"; do kill "$daemon" 2>/dev/null || true; done
  wait 2>/dev/null || true
  rm -rf "$folder"
}
trap clean_up EXIT

# A number that nothing listens on.
free_port() {
  local port=$((20000 + RANDOM % 20000))
  while (: <"/dev/tcp/127.0.0.1/$port") 2>/dev/null; do port=$((port + 1)); done
  echo "$port"
}

# Asks again until the command succeeds, for some seconds.
wait_for() {
  local seconds=$1 what=$2
  shift 2
  for ((i = 0; i < 5 * seconds; ++i)); do
    if "$@" >/dev/null 2>&1; then return; fi
    sleep 0.2
  done
  echo "slurm: waited $seconds s for $what" >&2
  return 1
}

mkdir "$folder/state" "$folder/spool" "$folder/munge"
(umask 077 && head -c 1024 /dev/urandom >"$folder/munge/key")
munged --foreground --force --key-file="$folder/munge/key" --socket="$folder/munge/socket" \
  --pid-file="$folder/munge/pid" --log-file="$folder/munge.log" \
  --seed-file="$folder/munge/seed" >"$folder/munged.log" 2>&1 &
daemons+=($!)
wait_for 10 "munged" test -S "$folder/munge/socket"

host=$(hostname -s)
# A job that is queued again waits until its credential has expired: 120 seconds, by default.
cat >"$SLURM_CONF" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
AuthType=auth/munge
AuthInfo=cred_expire=5;socket=$folder/munge/socket
StateSaveLocation=$folder/state
SlurmdSpoolDir=$folder/spool
SlurmctldPidFile=$folder/slurmctld.pid
SlurmdPidFile=$folder/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2,batch_sched_delay=0
MailProg=/bin/true
ReturnToService=2
MinJobAge=600
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc)
PartitionName=all Nodes=ALL Default=YES MaxTime=10 State=UP
CONF
slurmctld -D >"$folder/slurmctld.log" 2>&1 &
daemons+=($!)
slurmd -D >"$folder/slurmd.log" 2>&1 &
daemons+=($!)
is_idle() { [[ $(sinfo -h -o %t 2>/dev/null) == idle ]]; }
wait_for 30 "a node that is idle" is_idle
sinfo

cd "$folder"
submit() { sbatch --parsable "$@"; }
states_of() { scontrol -o show job "$1" | grep -o 'JobState=[A-Z_]*' | sort | uniq -c | xargs; }
are_done() { ! squeue -h -j "$1" -t PENDING,RUNNING,COMPLETING,CONFIGURING | grep -q .; }
fail() {
  echo "slurm: $*" >&2
  return 1
}
must_be() { [[ $2 == "$3" ]] || fail "$1: '$2' where '$3' was expected"; }
same() { "$PAHRENDER" compare "$1" "$2" --threshold 0 >/dev/null || fail "$1 is not $2"; }

# The blocks of the document that name the scripts: submitting all, and one part again.
mapfile -d '' blocks < <(awk '
  /^```$/ {if (block ~ /scenes\/slurm/) printf "%s%c", block, 0; inside = 0; block = ""}
  inside {block = block $0 "\n"}
  /^```sh$/ {inside = 1}' "$source/docs/command_line.md")
must_be "the document's blocks of commands for Slurm" "${#blocks[@]}" 2

# They are for a scene.yaml here: the turntable, small.
ln -s "$scenes" scenes
ln -s "$scenes/meshes" meshes
sed 's/width: 480, height: 360/width: 48, height: 36/; s/samples: 64/samples: 2/' \
  "$scenes/turntable.yaml" >scene.yaml
whole() { "$PAHRENDER" scene.yaml --quiet "$@"; }

echo "The document's commands, while part 3 cannot be written:"
mkdir picture.exr.part-3.film
parts='' merge=''
eval "${blocks[0]}" >submitted
frames=$(awk '/^Submitted batch job/ {print $4}' submitted)
wait_for 120 "the parts and frames" are_done "$parts,$frames"
merge_reason() { scontrol -o show job "$merge" | grep -o 'JobState=[A-Z]* Reason=[A-Za-z]*'; }
is_held() { [[ $(merge_reason) == "JobState=PENDING Reason=DependencyNeverSatisfied" ]]; }
wait_for 60 "the merge to be held" is_held
echo "parts: $(states_of "$parts"); merge: $(merge_reason); frames: $(states_of "$frames")"
must_be "the parts" "$(states_of "$parts")" "7 JobState=COMPLETED 1 JobState=FAILED"
[[ ! -e picture.exr ]] || fail "there is a picture without part 3"
grep -q -- '--array=3 ' "slurm-${parts}_3.out" || fail "the log of part 3 does not name it"
grep -q 'cannot write' "slurm-${parts}_3.out" || fail "the log of part 3 does not say why it failed"

must_be "the frames" "$(states_of "$frames")" "24 JobState=COMPLETED"
whole --frames 0:24 -o whole_####.png
for frame in frame_*.png; do same "$frame" "whole_${frame#frame_}"; done

echo "The document's commands for that part again:"
rmdir picture.exr.part-3.film
eval "${blocks[1]}"
wait_for 120 "the picture" are_done "$merge"
echo "merge: $(states_of "$merge"): $(cat "slurm-$merge.out")"
must_be "the merge" "$(states_of "$merge")" "1 JobState=COMPLETED"
whole -o whole.exr --spp 256
same picture.exr whole.exr

echo "Frames submitted again, one of them missing:"
rm frame_0001.png
frames=$(submit --array=0-2 "$scenes/slurm/frame.sh" scene.yaml 'frame_####.png')
wait_for 120 "the frames" are_done "$frames"
must_be "the frames" "$(states_of "$frames")" "3 JobState=COMPLETED"
cat "slurm-${frames}"_[0-2].out
same frame_0001.png whole_0001.png
must_be "the frames that were kept" "$(grep -l 'is already complete' "slurm-${frames}"_?.out | wc -l)" 2

echo "Names with blanks, and 10 samples in 4 parts of 2 CPUs:"
parts=$(submit --array=0-3 --cpus-per-task=2 "$scenes/slurm/part.sh" scene.yaml "a picture.exr" 10 4)
merge=$(submit --dependency=afterok:"$parts" "$scenes/slurm/merge.sh" "a picture.exr")
wait_for 120 "the picture" are_done "$parts,$merge"
echo "parts: $(states_of "$parts"); merge: $(states_of "$merge")"
whole -o whole.exr --spp 10
same "a picture.exr" whole.exr

echo "A part that is queued again while it runs:"
parts=$(submit --array=0 --open-mode=append "$scenes/slurm/part.sh" scene.yaml long.exr 6000 1)
merge=$(submit --dependency=afterok:"$parts" "$scenes/slurm/merge.sh" long.exr)
log=slurm-${parts}_0.out
wait_for 60 "the part to run" grep -q "starting from the beginning" "$log"
sleep 2
scontrol requeue "${parts}_0"
wait_for 120 "the picture" are_done "$parts,$merge"
cat "$log"
grep -q 'resuming from' "$log" || fail "it did not go on"
whole -o whole.exr --spp 6000
same long.exr whole.exr

touch long.exr.part-0.film.film
if "$scenes/slurm/merge.sh" long.exr 2>merge.out; then fail "a part that is not complete was merged"; fi
cat merge.out
grep -q -- '--array=0 ' merge.out || fail "the part that is not complete is not named"

echo "An array with more tasks than parts:"
parts=$(submit --array=1 "$scenes/slurm/part.sh" scene.yaml many.exr 4 1)
wait_for 60 "the part" are_done "$parts"
must_be "part 1 of 1" "$(states_of "$parts")" "1 JobState=FAILED"
cat "slurm-${parts}_1.out"
