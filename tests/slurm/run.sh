#!/usr/bin/env bash
# The job scripts of scenes/slurm on a Slurm of one node: parts of a picture and their merging,
# frames, and a part that fails.
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
scenes=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../scenes" && pwd)

PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch squeue sinfo scontrol; do
  command -v "$program" >/dev/null || cannot "there is no $program here"
done
((EUID == 0)) || cannot "slurmd starts jobs as root only"

folder=$(mktemp -d)
chmod 755 "$folder"
daemons=()
clean_up() {
  local status=$?
  if ((status != 0)); then tail -n 20 "$folder"/*.log "$folder"/*.out 2>/dev/null || true; fi
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
cat >"$folder/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
AuthType=auth/munge
AuthInfo=socket=$folder/munge/socket
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
export SLURM_CONF=$folder/slurm.conf
slurmctld -D >"$folder/slurmctld.log" 2>&1 &
daemons+=($!)
slurmd -D >"$folder/slurmd.log" 2>&1 &
daemons+=($!)
is_idle() { [[ $(sinfo -h -o %t 2>/dev/null) == idle ]]; }
wait_for 30 "a node that is idle" is_idle
sinfo

cd "$folder"
submit() { sbatch --parsable --output='%x-%A_%a.out' "$@"; }
state_of() { scontrol -o show job "$1" | grep -o 'JobState=[A-Z_]*' | sort | uniq -c; }
are_done() { ! squeue -h -j "$1" -t PENDING,RUNNING,COMPLETING,CONFIGURING | grep -q .; }

scene=$scenes/cornell_box.yaml
size=(--width 48 --height 27)
echo "A picture of 10 samples in 4 parts:"
parts=$(submit --array=0-3 "$scenes/slurm/part.sh" "$scene" "a picture.exr" 10 4 "${size[@]}")
merge=$(submit --dependency=afterok:"$parts" "$scenes/slurm/merge.sh" "a picture.exr")
wait_for 120 "the picture" are_done "$parts,$merge"
state_of "$parts"
state_of "$merge"
"$PAHRENDER" "$scene" -o whole.exr --spp 10 "${size[@]}" --quiet
"$PAHRENDER" compare "a picture.exr" whole.exr --threshold 0

echo "Three frames:"
scene=$scenes/turntable.yaml
frames=$(submit --array=5-7 "$scenes/slurm/frame.sh" "$scene" 'frame_####.exr' --width 48 --spp 2)
wait_for 120 "the frames" are_done "$frames"
state_of "$frames"
for frame in 5 6 7; do
  "$PAHRENDER" "$scene" -o whole.exr -D animation.frame=$frame --width 48 --spp 2 --quiet
  "$PAHRENDER" compare "frame_000$frame.exr" whole.exr --threshold 0
done

echo "A part that fails, and what depends on it:"
cp "$scenes/cornell_box.yaml" broken.yaml
echo "nonsense: 1" >>broken.yaml
parts=$(submit --array=0-1 "$scenes/slurm/part.sh" broken.yaml broken.exr 4 2 "${size[@]}")
merge=$(submit --dependency=afterok:"$parts" "$scenes/slurm/merge.sh" broken.exr)
has_failed() { [[ $(state_of "$parts") == *"2 JobState=FAILED"* ]]; }
never_runs() { scontrol -o show job "$merge" | grep -q 'Reason=DependencyNeverSatisfied'; }
wait_for 60 "the part to fail" has_failed
wait_for 60 "the merge to be held" never_runs
state_of "$parts"
scontrol -o show job "$merge" | grep -o 'JobState=[A-Z]* Reason=[A-Za-z]*'
grep -q "unknown key 'nonsense'" pahrender-part-*.out
[[ ! -e broken.exr ]]
