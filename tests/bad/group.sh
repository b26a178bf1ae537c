# In a control group of less memory than is asked for: refused by a sentence, not ended by the system; --scratch does with it.
[ -z "$SAN" ] || { echo "a sanitizer has its own malloc"; exit 77; }
group=/sys/fs/cgroup/mr-test.$$
mkdir "$group" 2>/dev/null && [ -e "$group/memory.max" ] && echo 150000000 2>/dev/null >"$group/memory.max" ||
    { rmdir "$group" 2>/dev/null; echo "control groups cannot be made here"; exit 77; }
trap 'rmdir "$group"' EXIT
within() { # command
	sh -c 'echo $$ >"$0" && exec "$@"' "$group/cgroup.procs" "$@"
}
mr-make torus -n 100 --points 9000000 -o cloud.mrs
mkdir scratch
within mr-make torus -n 100 --points 9000000 >out 2>err
code=$?
[ $code = 1 ] && [ ! -s out ] && grep -q 'no memory for 9000000 objects.*--scratch' err || { echo "exit $code, $(wc -c <out) bytes"; cat err; exit 1; }
within mr-make --scratch scratch torus -n 100 --points 9000000 >out && cmp cloud.mrs out
