# A stage that dies says why: each one behind it fails and says nothing more.
stage() { # name, command
	"$@" 2>"$n.err"
	echo "$n: exit $?, $(cat "$n.err")" >"$n.said"
}
mr-make plane -n 50 >plane.mrs
{ n=1 stage mr-cat no-such-file | n=2 stage mr-smooth | n=3 stage mr-remesh | n=4 stage mr-encode | n=5 stage mr-info; } >out
cat ?.said out
# One that says nothing, is killed or has a wrong command line: the one behind it says that it died, alone.
rm ?.said
{ sh -c 'kill -9 $$' 2>/dev/null | n=2 stage mr-smooth | n=3 stage mr-remesh | n=4 stage mr-info; } >out
cat ?.said out
rm ?.said
{ n=1 stage mr-make nothing | n=2 stage mr-smooth | n=3 stage mr-info; } 2>&1 >out
cat ?.said out
# -v says it all the same; so does what reads it elsewhere, and a file has no such end.
{ mr-cat no-such-file 2>/dev/null | mr-info -v 2>&1; } | cut -d: -f2-
mr-cat no-such-file 2>/dev/null | cat >said
python3 -c 'import os; os.setpgrp(); os.execvp("mr-info", ["mr-info"])' <said
mr-cat no-such-file >said 2>/dev/null
wc -c <said
rm -f ?.said
# Frames that came before it are passed on.
{ cat plane.mrs plane.mrs | head -c 5000 | n=1 stage mr-cat | n=2 stage mr-smooth | n=3 stage mr-info | grep -c position; } >out
cat ?.said out
