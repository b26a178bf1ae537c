# judge.sh -- for scripts that try packages: counts and says what went well; $work is a folder of theirs.
passed=0 failed=0 skipped=0
good() { echo "ok - $*"; passed=$((passed + 1)); }
bad() { echo "not ok - $*"; failed=$((failed + 1)); }
skip() { echo "ok - $1 # SKIP $2"; skipped=$((skipped + 1)); }
judge() { # name, command: its exit code judges
	name_of_test=$1
	shift
	"$@" >"$work/log" 2>&1 && good "$name_of_test" ||
		{ sed 's/^/# /' "$work/log" | tail -n 30; bad "$name_of_test"; }
}
finish() {
	echo "$passed passed, $failed failed, $skipped skipped"
	[ "$failed" -eq 0 ] || exit 1
	exit 0
}
