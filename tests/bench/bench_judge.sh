# What judging costs beside what it judges: CPU seconds of a tool with -q, where nobody listens, and what they are more without, medians of RUNS
# (default 5), of mr-decode, mr-simplify and mr-remesh on models of $DATA, and of mr-decode on 100 poses.
# Knobs: MODELS (files of $DATA/meshes), RUNS.
cpu() { # command line: its median
	for run in $(seq "${RUNS:-5}"); do
		( times_of "$@" )
	done | sort -g | awk '{ x[NR] = $1 } END { print x[int((NR + 1) / 2)] }'
}
times_of() {
	"$@" >out.mrs 2>err
	times >spent # in a pipe it would be of another shell
	sed -n '2s/[ms]/ /gp' spent | awk '{ print 60 * $1 + $2 + 60 * $3 + $4 }'
}
compare() { # case, command line
	case=$1
	shift
	doing=$(cpu "$@" -q)
	both=$(cpu "$@")
	echo "$case-doing mr $doing s"
	echo "$case-judging mr $(echo "$both $doing" | awk '{ print ($1 - $2) }') s"
	echo "$case-share mr $(echo "$both $doing" | awk '{ print ($1 - $2) / $2 }') of-doing"
}
for file in ${MODELS:-stanford-bunny.obj.gz nefertiti.obj.gz igea.ply.gz}; do
	[ -f "$DATA/meshes/$file" ] || { echo "no model $file in $DATA/meshes" >&2; continue; }
	name=${file%%.*}
	mr-import -q --repair "$DATA/meshes/$file" -o mesh.mrs || exit
	mr-smooth -q mesh.mrs -o smooth.mrs || exit
	mr-remesh -q smooth.mrs | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 | mr-encode -q -o rest.mrs || exit
	mr-pose -H 1 --rotate 0,0,1,60 rest.mrs | mr-solve -q -o posed.mrs || exit
	compare "decode-$name" mr-decode posed.mrs
	compare "simplify-$name" mr-simplify -n 5000 mesh.mrs
	compare "remesh-$name" mr-remesh smooth.mrs
	case $name in
	*bunny*)
		mr-pose -H 1 --rotate 0,0,1,60 --frames 100 rest.mrs | mr-solve -q -o poses.mrs || exit
		RUNS=3 compare "decode-100-poses" mr-decode poses.mrs
		;;
	esac
done
