# examples/batch on a real Slurm: four virtual nodes, one killed in the middle, the controller restarted, make the bytes of
# `make`, as an array job and by a job for each rule; a broken model is told of in its own words, and keeps back no other.
# MODELS=N says how many models (16).  The cluster lives in namespaces of this script, without a network, and ends with it.
[ -z "$SAN" ] || { echo "schedulers have no use for sanitizers here"; exit 77; }
PATH=$PATH:/usr/sbin:/sbin
for command in slurmctld slurmd sbatch munged ip; do
	command -v $command >/dev/null || { echo "no $command: make check-cluster installs Slurm"; exit 77; }
done
if [ "$1" != inside ]; then
	unshare --pid --net --uts --fork --mount-proc ip link set lo up 2>/dev/null || { echo "no namespaces for a cluster: not root?"; exit 77; }
	exec unshare --pid --net --uts --fork --kill-child --mount-proc sh "$0" inside
fi

count=${MODELS:-16}
tasks=$(((count + 49) / 50 + 7))
batch=$TOP/examples/batch
fail=0
complain() { echo "$*"; fail=1; }
took() { # what, since when: for make check-cluster to show
	echo "$1: $(echo "$2 $(date +%s.%N)" | awk '{ printf "%.1f", $2 - $1 }') s" | tee -a "$BUILD/cluster.txt"
}
rm -f "$BUILD/cluster.txt"

# Runs until it is true, for some minutes.
await() { # seconds, command
	deadline=$(($(date +%s) + $1))
	shift
	until "$@" >/dev/null 2>&1; do
		[ "$(date +%s)" -lt $deadline ] || { complain "waited in vain for: $*"; return 1; }
		sleep 0.5
	done
}

# The cluster: munge, a controller, and nodes, each in a namespace that takes all its processes along when it is killed.
cluster=$PWD/cluster
export SLURM_CONF=$cluster/slurm.conf
configure() {
	hostname localhost
	# Names are resolved only where a device has an address beside 127.0.0.1; this one is for documentation.
	ip link set lo up && ip address add 192.0.2.1/32 dev lo
	mkdir -p "$cluster/state" && chmod 755 "$cluster"
	head -c 1024 /dev/urandom >"$cluster/munge.key" && chmod 400 "$cluster/munge.key"
	cat >"$SLURM_CONF" <<-END
		ClusterName=virtual
		SlurmctldHost=localhost(127.0.0.1)
		SlurmUser=root
		AuthType=auth/munge
		AuthInfo=socket=$cluster/munge.socket,cred_expire=5
		StateSaveLocation=$cluster/state
		SlurmctldPidFile=$cluster/slurmctld.pid
		SlurmdPidFile=$cluster/%n.pid
		SlurmdSpoolDir=$cluster/%n
		ProctrackType=proctrack/linuxproc
		TaskPlugin=task/none
		MpiDefault=none
		SelectType=select/cons_tres
		SelectTypeParameters=CR_CPU
		SchedulerType=sched/builtin
		SchedulerParameters=batch_sched_delay=0,sched_interval=1
		SlurmdTimeout=15
		ReturnToService=2
		MaxArraySize=20001
		MaxJobCount=40000
		NodeName=n[1-4] NodeHostname=localhost NodeAddr=127.0.0.1 Port=[6821-6824] CPUs=1
		PartitionName=all Nodes=n[1-4] Default=YES MaxTime=INFINITE State=UP
	END
	# By force, since it takes it for a mistake that the folder of a test is closed to others.
	munged -F --force --key-file="$cluster/munge.key" --socket="$cluster/munge.socket" --pid-file="$cluster/munged.pid" \
	    --log-file="$cluster/munged.log" --seed-file="$cluster/munge.seed" >"$cluster/munged.err" 2>&1 &
	await 20 [ -S "$cluster/munge.socket" ]
}
start_controller() {
	slurmctld -D -f "$SLURM_CONF" >>"$cluster/controller.log" 2>&1 &
	controller=$!
	await 60 sinfo
}
restart_controller() {
	kill $controller && wait $controller
	sleep 3
	start_controller
}
start_node() { # number
	mkdir -p "$cluster/n$1"
	unshare --pid --fork --kill-child --mount-proc sh -c 'slurmd -D -f "$SLURM_CONF" -N "$0"; :' "n$1" >"$cluster/n$1.log" 2>&1 &
	eval "node$1=\$!"
}
kill_node() { # number
	eval "kill -9 \$node$1"
}
up() { # number of nodes
	[ "$(sinfo -h -t idle,alloc,mix -o %D | awk '{ n += $1 } END { print n + 0 }')" -ge "$1" ]
}

make_models() {
	mkdir models
	for i in $(seq "$count"); do
		name=models/$(printf %05d "$i")
		case $((i % 4)) in
		0) mr-make sphere --points 200 --noise 0.5% --seed "$i" | mr-export "$name.xyz" ;;
		1) mr-make torus -n 200 --noise 0.5% --seed "$i" | mr-export "$name.ply" ;;
		2) mr-make boxes -n 200 --noise 0.5% --seed "$i" | mr-export "$name.off" ;;
		3) mr-make sphere -n 200 --noise 1% --seed "$i" | mr-export "$name.obj" ;;
		esac || exit
	done
	head -c 1000 models/00001.ply >models/broken.ply
}
batch() { # arguments of make
	make -s -f "$batch/Makefile" IN="$PWD/models" "$@"
}
made() { # folder: number of pictures
	find "$1" -name picture.png 2>/dev/null | wc -l
}
begun() { # folder, number of models
	[ "$(ls "$1" | wc -l)" -ge "$2" ]
}
over() {
	squeue -h -r >queue && [ ! -s queue ]
}
# All results are those of make, byte for byte; what fails says why.  Times are in the .json, and so in figures.tsv.
judge() { # folder
	batch OUT="$1" report >"$1.report" 2>&1 && complain "$1: a broken model is reported as made"
	diff -r -q -x '*.json' -x figures.tsv serial "$1" >"$1.differences" || { head -n 20 "$1.differences"; complain "$1 differs from make"; }
	[ "$(made "$1")" -eq "$count" ] || complain "$1: $(made "$1") of $count made"
	[ "$(wc -l <"$1/figures.tsv")" -eq $((count + 1)) ] || complain "$1: $(wc -l <"$1/figures.tsv") rows of figures"
	[ "$(cut -f1 "$1/failed.txt")" = broken.ply ] && grep -q 'mr-import: .*models/broken.ply: byte' "$1/failed.txt" ||
	    { cat "$1/failed.txt"; complain "$1: failed.txt is not the broken model's sentence"; }
}

begin=$(date +%s.%N)
make_models
took "$count models made" "$begin"

# The reference, one after another; of many models by two at a time.
begin=$(date +%s.%N)
batch -j $((count > 1000 ? 2 : 1)) OUT=serial >serial.log 2>&1 && complain "make succeeds with a broken model"
took "make -j$((count > 1000 ? 2 : 1))" "$begin"
judge serial
batch -j2 OUT=serial -q models 2>/dev/null && complain "make believes the broken model made"
batch -k -n OUT=serial models 2>/dev/null | grep -v broken | grep -q mr- && complain "a second make makes something again"

configure
start_controller
for node in 1 2 3 4; do
	start_node $node
done
await 60 up 4 || { cat "$cluster"/*.log; exit 1; }

# An array job.
begin=$(date +%s.%N)
mkdir -p array
(cd "$batch" && sbatch --array="0-$((tasks - 1))" --output=/dev/null array.sh IN="$OLDPWD/models" OUT="$OLDPWD/array" >/dev/null) || complain "sbatch fails"
await 3600 begun array $((count / 4)) && kill_node 2
await 3600 begun array $((count / 2)) && restart_controller
await 3600 over || { squeue; tail -n 30 "$cluster/controller.log"; }
took "array job, a node killed, the controller restarted" "$begin"
judge array

# A job for each rule.
if [ "$count" -le 1000 ]; then
	mkdir rules
	begin=$(date +%s.%N)
	(cd rules && exec make -s -j4 -f "$batch/Makefile" IN="$OLDPWD/models" OUT="$OLDPWD/rules" SHELL="$batch/srun-shell") >rules.log 2>&1 &
	rules=$!
	await 600 begun rules $((count / 4)) && kill_node 3
	wait $rules && complain "make succeeds on Slurm with a broken model"
	took "a job for each rule, another node killed" "$begin"
	judge rules
fi
exit $fail
