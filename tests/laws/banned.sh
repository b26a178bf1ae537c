# The library neither prints nor exits nor asks for the time of day; no tool opens a connection or starts a program;
# calls that lose an error or a bound are nowhere.
# The sources without their comments and strings, under the same names.
for file in $(cd "$TOP" && find lib formats cmd -name '*.[ch]' ! -name banned.h -o -name '*.cc'); do
	mkdir -p "${file%/*}"
	sed -E 's/"([^"\\]|\\.)*"/""/g' "$TOP/$file" |
		sed -E 's,//.*,,; s,/\*.*\*/,,; /^[ \t]*\/\*/,/\*\//d; s,/\*.*,,' >"$file"
done
fail=0

search() { # calls, files and directories
	calls=$1
	shift
	grep -rnE "(^|[^a-zA-Z0-9_])($calls)[ \t]*\(" "$@"
}

bad=$(search 'atoi|atol|atoll|atof|sprintf|vsprintf|strcpy|strcat|gets|strtok|scanf|sscanf|alloca' lib formats cmd)
[ -z "$bad" ] || { echo "banned:"; echo "$bad"; fail=1; }
bad=$(search 'printf|vprintf|puts|putchar|perror|exit|_exit|abort|assert|signal' lib formats)
[ -z "$bad" ] || { echo "the library prints or exits:"; echo "$bad"; fail=1; }
# The front end is there to start the tools.
tools=$(ls -d cmd/* | grep -v '^cmd/mr\.c$')
bad=$(search 'socket|system|popen|v?fork|execlp?|execvp?|execve|posix_spawnp?' lib formats $tools)
[ -z "$bad" ] || { echo "a connection or another program:"; echo "$bad"; fail=1; }
# The way of libpng and libjpeg to fail, and ours where memory runs out.
bad=$(search 'longjmp|setjmp' lib cmd $(ls formats/*.c | grep -vE 'formats/(png|jpeg).c') |
	grep -v '^lib/base/ctx\.[ch]:')
[ -z "$bad" ] || { echo "jumps:"; echo "$bad"; fail=1; }
bad=$(search 'rand|srand|random|drand48|time|gettimeofday|getenv|setlocale' lib formats)
[ -z "$bad" ] || { echo "a result may depend on these:"; echo "$bad"; fail=1; }
bad=$(search 'malloc|calloc|realloc|free|sqrt|sin|cos|exit|atexit' cmd | grep -E '^cmd/mr-')
[ -z "$bad" ] || { echo "commands compute, allocate or exit:"; echo "$bad"; fail=1; }
cd "$TOP" || exit
bad=$(grep -rnE '\b(TODO|FIXME|XXX|HACK)\b' lib formats cmd tests/unit man Makefile README.md )
[ -z "$bad" ] || { echo "unfinished:"; echo "$bad"; fail=1; }
exit $fail
