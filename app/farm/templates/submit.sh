#!/bin/bash
# Submits the frames of this folder to Slurm and prints the job of each step. Options of sbatch may follow (--partition,
# --account, --time, ...). MENISCUS is the program, if it is not `meniscus` in PATH. Submit again to continue after a
# failure: finished frames stay. MENISCUS_WORK_OPTIONS="--step surface" makes one step only;
# MENISCUS_VERIFY_OPTIONS="--allow-missing hold" makes the film in spite of frames that cannot be made.
set -euo pipefail
cd -- "$(dirname -- "${BASH_SOURCE[0]}")"
mkdir -p logs
export MENISCUS="${MENISCUS:-meniscus}"
largest=$(scontrol show config | awk '$1 == "MaxArraySize" {print $3}')
if [ "${largest:-1001}" -le @COUNT@ ]; then
  echo "this Slurm takes arrays of $((largest - 1)) tasks, the bundle has @COUNT@: bundle with larger chunks" >&2
  exit 2
fi
job=$(sbatch --parsable "$@" slurm/work.sbatch)
echo "work $job"
job=$(sbatch --parsable --dependency="afterany:$job" "$@" slurm/verify.sbatch)
echo "verify $job"
