# Columns that hold what they cannot, under checksums that are right, before one command of each tool: every way with LONG=1,
# else every 97th, and under a sanitizer fewer.
mkdir made
fail=0
try() { # command
	python3 "$TOP/tests/faults/columns.py" "$([ -n "$LONG" ] && echo 1 || echo $((97 * SPARSE)))" "$@" || fail=1
}
. "$TOP/tests/faults/commands.sh"
exit $fail
