# A stage that dies: each one behind it fails with one short line of its own.
stage() { # name, command
	"$@" 2>"$n.err"
	echo "$n: exit $?, $(cat "$n.err")" >"$n.said"
}
mr-make plane -n 50 >plane.mrs
{ n=1 stage mr-cat no-such-file | n=2 stage mr-smooth | n=3 stage mr-remesh | n=4 stage mr-encode | n=5 stage mr-info; } >out
cat ?.said out
# Frames that came before it are passed on.
{ cat plane.mrs plane.mrs | head -c 5000 | n=1 stage mr-cat | n=2 stage mr-smooth | n=3 stage mr-info | grep -c position; } >out
cat ?.said out
