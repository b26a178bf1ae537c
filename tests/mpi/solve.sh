# mr-solve-mpi puts each vertex where mr-solve does, for every order and number of processes; factors once for all poses; fails as
# mr-solve does; and a rank that dies leaves no stream that is taken for whole.
[ -z "$SAN" ] || { echo "MPI is not built for sanitizers"; exit 77; }
PATH=$BUILD/mpi:$PATH
command -v mr-solve-mpi >/dev/null || { echo "there is no mr-solve-mpi: make check-mpi builds it"; exit 77; }
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
export OMPI_MCA_orte_tmpdir_base="$PWD"
fail=0
bad() {
	echo "$*"
	fail=1
}
solve() { # processes, options
	n=$1
	shift
	mpirun -n "$n" mr-solve-mpi "$@"
}
mr-make bumpy -n 4000 | mr-smooth | mr-remesh | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 --handle 2=above:x,0.9 -o rest.mrs || exit
mr-pose -H 1 --translate 0.5,0.3,0 --rotate 0,0,1,40 rest.mrs | mr-pose -H 2 --rotate 1,0,0,30 -o posed.mrs || exit

off() { mr-export -q -f off -l base - <"$1"; }
near() { # stream, stream
	off "$1" >one.off && off "$2" >other.off && near_off one.off other.off
}
near_off() { # file, file: no vertex is 1e-8 of the diagonal from where the other has it
	paste "$1" "$2" | awk 'NR > 2 && NF == 6 {
			for (i = 1; i <= 3; i++) {
				d = $i - $(i + 3); d = d < 0 ? -d : d; most = d > most ? d : most
				low[i] = n && low[i] < $i ? low[i] : $i; high[i] = n && high[i] > $i ? high[i] : $i
			}
			n++
		}
		END { size = sqrt((high[1] - low[1]) ^ 2 + (high[2] - low[2]) ^ 2 + (high[3] - low[3]) ^ 2)
			printf "%.2g of the diagonal, %d vertices\n", most / size, n; exit !(n > 1000 && most <= 1e-8 * size) }'
}
for k in 1 2 3; do
	mr-solve -k $k posed.mrs -o one.mrs || exit
	for n in 1 2 4; do
		solve $n -k $k <posed.mrs 2>err | cat >many.mrs
		[ ! -s err ] || bad "-n $n -k $k says: $(cat err)"
		near one.mrs many.mrs || bad "-n $n -k $k is not what mr-solve -k $k has"
	done
done

# The response to handles, several right-hand sides at a time, and with it any pose.
for n in 1 2; do
	if [ $n = 1 ]; then mr-solve --basis rest.mrs; else solve 2 --basis rest.mrs; fi | mr-encode -q |
		mr-pose -H 1 --translate 0.5,0.3,0 --rotate 0,0,1,40 | mr-decode -q -o basis$n.mrs || exit
done
near basis1.mrs basis2.mrs || bad "--basis is not what mr-solve --basis has"

# All poses of a film by one factor.
mr-solve --no-history rest.mrs | mr-pose -H 1 --translate 0,0,0.5 --frames 3 -o film.mrs || exit
solve 2 --stats stats film.mrs -o many.mrs && mr-solve film.mrs -o one.mrs || exit
mr-export -q -f off -l base 'one-%d.off' <one.mrs && mr-export -q -f off -l base 'many-%d.off' <many.mrs || exit
for i in 1 2 3 4; do
	near_off one-$i.off many-$i.off || bad "frame $i of a film is not what mr-solve has"
done
[ "$(grep -o '"seconds_factor":[^,}]*' stats | sort | uniq -c | awk '{ print $1 }')" = 4 ] || bad "not all poses are by one factor: $(cat stats)"

# Failures are those of mr-solve.
solve 2 --nonsense posed.mrs >out 2>err
[ $? = 2 ] || bad "a wrong command line: exit $?"
head -c 5000 posed.mrs | solve 2 >out 2>err
[ $? = 1 ] && grep -q '^mr-solve-mpi: ' err && ! mr-info out >/dev/null 2>&1 || bad "half a stream: $(cat err)"
solve 2 -s cholesky --memory 0.1 posed.mrs >out 2>err
[ $? = 1 ] && grep -q 'of one of 2 processes, more than it has' err || bad "too little memory: $(cat err)"
solve 2 --memory 0.1 -o many.mrs posed.mrs 2>err && grep -q 'multigrid takes its place' err && mr-solve posed.mrs -o one.mrs &&
	off many.mrs >/dev/null || bad "too little memory, by choice: $(cat err)"
solve 2 "$TOP/README.md" >out 2>err
[ $? = 1 ] || bad "no stream: exit $?"

# A rank that dies while there is work.
mr-make bumpy -n 60000 | mr-smooth -q | mr-select --free all --fixed below:y,0.2 --handle 1=above:y,0.8 | mr-pose -q -H 1 --translate 0.1,0.3,0 -o large.mrs || exit
mpirun -n 3 mr-solve-mpi -k 3 large.mrs >out 2>err &
job=$!
rank() { # the process of a rank of this job
	for pid in $(pgrep -P $job); do
		tr '\0' '\n' <"/proc/$pid/environ" 2>/dev/null | grep -qx "OMPI_COMM_WORLD_RANK=$1" && echo "$pid"
	done
}
tries=0
until [ -n "$(rank 2)" ] || [ $((tries += 1)) -gt 200 ]; do
	sleep 0.05
done
sleep 0.3
kill -9 "$(rank 2)" || bad "no rank to kill"
wait $job && bad "a rank is killed, and the job ends well"
[ -s err ] || bad "a rank is killed, and nobody says so"
mr-info out >/dev/null 2>&1 && bad "a rank is killed, and the stream is whole"
exit $fail
