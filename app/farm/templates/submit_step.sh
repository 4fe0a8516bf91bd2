read -r -a options <<<"${MENISCUS_@UPPER@_OPTIONS:-}"
job=$(sbatch --parsable @DEPENDENCY@"$@" "${options[@]}" slurm/@STEP@.sbatch)
echo "@STEP@ $job"
