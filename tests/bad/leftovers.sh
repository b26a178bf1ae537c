# Whatever ends a command, what was there stays as it was and nothing unfinished is left beside it.
[ -z "$SAN" ] || { echo "a sanitizer has signals of its own"; exit 77; }
ulimit -c 0
bad() { echo "$*"; ls -l work; exit 1; }
mr-make sphere -n 100 -o s.mrs
head -c $(($(wc -c <s.mrs) - 64)) s.mrs >open.mrs # without END: the command waits for more
mkfifo pipe
mkdir work
n=0

# The command at work, its process in $pid: its files are open.
begin() { # command
	"$@" <pipe 2>err &
	pid=$!
	exec 3>pipe
	cat open.mrs >&3
	while kill -0 $pid; do
		[ "$(find work -name 'mr-*~' | wc -l)" -lt 2 ] || return
		sleep 0.01
	done
}

# INT and QUIT are ignored here by what runs behind a shell; XFSZ and a closed pipe have their own tests.
outputs='mr-cat -o work/out.mrs
mr-export -f obj work/out
mr-export -f stl work/out.gz'
[ -z "$LONG" ] || outputs="$outputs
$(for format in obj ply ply-ascii stl-ascii off xyz pts; do echo "mr-export -q -f $format work/out.gz"; done)
mr-info -o work/out"
echo "$outputs" >outputs
ends="HUP ILL TRAP ABRT BUS FPE USR1 SEGV USR2 PIPE ALRM TERM XCPU VTALRM SYS"
for signal in $ends; do
	while read -r command; do
		echo old >work/out
		echo older >work/out.gz
		echo mrmesh1 >work/out.mrs
		begin $command --stats work/stats
		kill -$signal $pid
		wait $pid 2>wait
		code=$?
		exec 3>&-
		[ $code -gt 128 ] || bad "$command: exit $code after $signal: $(cat err)"
		[ "$(ls work)" = "$(printf 'out\nout.gz\nout.mrs')" ] || bad "$command: $signal leaves something"
		[ "$(cat work/out work/out.gz work/out.mrs)" = "$(printf 'old\nolder\nmrmesh1')" ] || bad "$command: $signal took what was there"
		n=$((n + 1))
	done <outputs
done

# One for each frame, while it is written.
mr-make sphere -n 300000 -o big.mrs
for signal in TERM HUP; do
	mr-export 'work/%d.obj.gz' <big.mrs &
	until ls work | grep -q '~'; do sleep 0.01; done
	kill -$signal $!
	wait $! 2>wait && bad "mr-export: exit 0 after $signal"
	[ "$(ls work)" = "$(printf 'out\nout.gz\nout.mrs')" ] || bad "mr-export: $signal leaves something"
done
echo "$n ends"
