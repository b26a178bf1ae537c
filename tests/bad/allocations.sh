# Each allocation fails once, of the tools and of the libraries below them: exit 1 and one sentence, or the same
# bytes as ever.  Every one with LONG=1 (make check-long), else the first ones and some further on.
[ -z "$SAN" ] || { echo "a sanitizer has its own malloc"; exit 77; }
cc -shared -fPIC -O1 -o malloc.so "$TOP/tests/faults/malloc.c" || exit
export OPENBLAS_NUM_THREADS=1 OMP_NUM_THREADS=1
runs=0 failed=0
mkdir made

is_empty() { # folder
	set -- "$1"/*
	[ ! -e "$1" ]
}
# What came of one run: in $code and the files out, made and err.
run() { # command
	is_empty made || rm -rf made/*
	timeout 60 env LD_PRELOAD="$PWD/malloc.so" "$@" >out 2>err
	code=$?
}
complain() {
	failed=$((failed + 1))
	[ $failed -gt 40 ] || { echo "allocation $k of $n, $*"; head -n 3 err; }
}
judge() {
	case $code in
	0)
		cmp -s out good && { is_empty made && is_empty good.made || diff -r made good.made >differences 2>&1; } || complain "other bytes: $*"
		;;
	1)
		grep -q . err && ! grep -q ': *$' err || complain "no sentence: $*"
		for file in made/*; do # of several files the first may be there, whole
			[ ! -f "$file" ] || cmp -s "$file" "good.$file" || complain "leaves $file: $*"
		done
		;;
	*) complain "exit $code: $*" ;;
	esac
}
# Allocations 1 to 12, then 2/5 further on.
every() {
	[ -z "$LONG" ] || { seq "$1"; return; }
	awk -v n="$1" 'BEGIN { for (k = 1; k <= n; k += k < 12 ? 1 : int(2 * k / 5)) print k }'
}
try() { # command
	unset FAIL_AT
	export ALLOCATIONS=$PWD/count
	run "$@"
	unset ALLOCATIONS
	[ $code = 0 ] || { echo "$*: exit $code without a fault"; cat err; exit 1; }
	n=$(cat count)
	mv out good
	rm -rf good.made
	cp -r made good.made
	for k in $(every "$n"); do
		export FAIL_AT=$k
		run "$@"
		judge "$@"
		runs=$((runs + 1))
	done
	unset FAIL_AT
}

. "$TOP/tests/faults/commands.sh"
echo "$runs runs, $failed wrong"
[ $failed = 0 ]
