#!/bin/sh
#SBATCH --job-name=mr-batch --requeue --open-mode=append --output=array-%a.log
# array.sh -- the models as an array job; usage, here: sbatch --array=0-99 array.sh [IN=models] [OUT=results]
# Task k of n makes every n-th model from the k-th on.  When its node is lost Slurm runs it again, and it makes what
# lacks.
make -s names "$@" | awk -v k="$SLURM_ARRAY_TASK_ID" -v n="$SLURM_ARRAY_TASK_COUNT" 'NR % n == k % n' |
    xargs -r make -k -j "${SLURM_CPUS_ON_NODE:-1}" "$@"
