# The runner itself: what fails is counted and fails the run, what passes passes, nothing run is a failure.
fail=0
bad() {
	echo "$*"
	fail=1
}
mkdir -p top/tests/cmd top/tests/laws top/tests/unit top/man top/build/tests
cp "$TOP/tests/run" top/tests/run
echo 'echo one' >top/tests/cmd/good.sh && echo one >top/tests/cmd/good.out
echo 'echo one' >top/tests/cmd/wrong.sh && echo two >top/tests/cmd/wrong.out
echo 'echo one >&2' >top/tests/cmd/noisy.sh && : >top/tests/cmd/noisy.out
echo 'echo "mr-a: frame 1: warning: 12 edges [folded]" >&2; echo "mr-a: 3 [s]"' >top/tests/cmd/kinds.sh
echo 'mr-a: [folded]' >top/tests/cmd/kinds.err && echo 'mr-a: 3 [s]' >top/tests/cmd/kinds.out
echo 'exit 3' >top/tests/cmd/exits.sh && : >top/tests/cmd/exits.out
echo 'exit 77' >top/tests/laws/skips.sh
echo 'sleep 60' >top/tests/laws/late.sh
: >top/tests/unit/test_silent.c && printf '#!/bin/sh\n' >top/build/tests/test_silent
: >top/tests/unit/test_dies.c && printf '#!/bin/sh\necho ok 1 - first\nkill -SEGV $$\n' >top/build/tests/test_dies
: >top/tests/unit/test_absent.c
chmod +x top/build/tests/*

try() { # expected last line, expected exit, arguments
	want=$1 exit=$2
	shift 2
	BUILD= LIMIT=2 top/tests/run "$@" >out 2>&1
	code=$?
	[ "$(tail -n 1 out)" = "$want" ] && [ $code -eq "$exit" ] ||
		bad "run $*: exit $code, $(tail -n 1 out), not $want"
}
try '1 passed, 0 failed' 0 cmd/good
try '1 passed, 0 failed' 0 cmd/kinds
try '0 passed, 1 failed' 1 cmd/wrong
try '0 passed, 1 failed' 1 cmd/noisy
try '0 passed, 1 failed' 1 cmd/exits
try '0 passed, 0 failed, 1 skipped' 1 laws/skips
try '0 passed, 1 failed' 1 laws/late
try '0 passed, 1 failed' 1 unit/test_silent
try '1 passed, 1 failed' 1 unit/test_dies
try '0 passed, 1 failed' 1 unit/test_absent
try '0 passed, 0 failed' 1 no-such-test
try '3 passed, 7 failed, 1 skipped' 1
try '5 passed, 0 failed' 0 --bless
try '5 passed, 0 failed' 0 cmd/
grep -q one top/tests/cmd/wrong.out && [ "$(cat top/tests/cmd/exits.exit)" = 3 ] &&
	grep -qx 'mr-a: \[folded\]' top/tests/cmd/kinds.err || bad "--bless wrote something else"
exit $fail
