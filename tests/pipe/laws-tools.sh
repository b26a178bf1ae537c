# What holds for every tool: help, wrong usage, broken input, full disks, terminals, the same bytes every time.
# A tool that is not named below is taken for a filter that needs no options.
fail=0
bad() {
	echo "$*"
	fail=1
}

# A frame that holds every layer that a filter may ask for.
regions='--reset --free all --fixed below:z,0.2 --handle 1=above:z,0.8'
mr-make bumpy -n 1000 | mr-smooth | mr-remesh | mr-select $regions | mr-solve --basis | mr-encode >edit.mrs || exit
mr-make sphere --points 300 >points.mrs || exit
mr-cat --merge edit.mrs points.mrs | mr-shrinkwrap -m cube -r 5 |
    mr-sample -n 1 >still.mrs || exit
mr-pose -H 1 --rotate 0,0,1,30 still.mrs >posed.mrs || exit
mr-make sphere -n 500 | mr-export plain.off || exit
mr-pack -q still.mrs plain.mrz || exit

# What a tool is given besides the stream.
arguments() {
	case $1 in
	mr-import) echo plain.off ;;
	mr-unpack) echo plain.mrz ;;
	mr-make) echo sphere -n 500 ;;
	mr-select) echo $regions ;;
	mr-pose) echo -H 1 --scale 2 ;;
	mr-transform) echo --up y:z --scale 2 ;;
	mr-crop) echo --drop below:y,0.2 ;;
	mr-split) echo -q ;;
	mr-map) echo -w out ;;
	mr-pack) echo -e 0.1% out.mrz ;;
	mr-compare) echo -a mesh ;;
	mr-align) echo -l mesh --from mesh still.mrs ;;
	mr-export) echo -l mesh out.ply ;;
	mr-render) echo -l mesh,base out.png ;;
	mr-view) echo -l mesh,base out.html ;;
	esac
}
# Source: reads no stream.  Sink: writes no stream.
kind() {
	case $1 in
	mr-import | mr-make | mr-unpack) echo source ;;
	mr-export | mr-pack | mr-render | mr-view | mr-info | mr-compare) echo sink ;;
	*) echo filter ;;
	esac
}
one_sentence() { # file, tool: one line that begins with the tool's name, besides warnings
	grep -v ': warning: ' "$1" >sentences
	[ "$(wc -l <sentences)" -eq 1 ] && grep -q "^$2: ." sentences
}
# Runs a command line: $code, out, err.
try() {
	"$@" >out 2>err
	code=$?
}

for path in "$BUILD"/bin/mr-*; do
	tool=${path##*/}
	set -- $(arguments "$tool")
	case $tool in mr-transform | mr-align) cp still.mrs all.mrs ;; *) cp posed.mrs all.mrs ;; esac

	try "$tool" --help
	[ $code -eq 0 ] && [ ! -s err ] && grep -q "^usage: $tool" out || bad "$tool --help: exit $code"
	try "$tool" -h
	[ $code -eq 0 ] && [ -s out ] || bad "$tool -h: exit $code"
	try "$tool" --version
	[ $code -eq 0 ] && [ ! -s err ] && [ "$(wc -l <out)" -eq 1 ] || bad "$tool --version: exit $code"
	"$tool" --help >/dev/full 2>err
	[ $? -eq 1 ] || bad "$tool --help >/dev/full does not fail"

	for wrong in --no-such-option '-j x' '-j 1x' '-j -1' --stats; do
		try "$tool" "$@" $wrong </dev/null
		[ $code -eq 2 ] || bad "$tool $wrong: exit $code, not 2"
		[ ! -s out ] || bad "$tool $wrong: writes to stdout"
		grep -q "^$tool: ." err || bad "$tool $wrong: says nothing"
	done

	if [ "$(kind "$tool")" = source ]; then
		"$tool" "$@" >first || bad "$tool $*: fails"
	else
		try "$tool" "$@" </dev/null
		[ $code -eq 1 ] || bad "$tool: empty stdin: exit $code, not 1"
		grep -q 'ends without END' err && one_sentence err "$tool" || bad "$tool: empty stdin: $(cat err)"
		for bytes in 1 63 64 100 5000 $(($(wc -c <all.mrs) - 64)) $(($(wc -c <all.mrs) - 1)); do
			head -c "$bytes" all.mrs >cut.mrs
			rm -f out.ply out.png out.html
			try "$tool" "$@" <cut.mrs
			[ $code -eq 1 ] || bad "$tool: a stream cut at $bytes bytes: exit $code, not 1"
			one_sentence err "$tool" || bad "$tool: a stream cut at $bytes bytes: $(cat err)"
			mr-cat <out >/dev/null 2>&1 && bad "$tool: a stream cut at $bytes bytes: a whole stream comes out"
		done
		"$tool" "$@" <all.mrs >first || bad "$tool $*: fails"
	fi

	# The same bytes from a file, from a pipe, for any number of threads; and to a file.
	for threads in 1 2 3; do
		if [ "$(kind "$tool")" = source ]; then
			"$tool" "$@" -j $threads >again || bad "$tool -j $threads: fails"
		else
			cat all.mrs | "$tool" "$@" -j $threads >again || bad "$tool -j $threads: fails"
		fi
		cmp first again || bad "$tool -j $threads: other bytes"
		for made in out.ply out.png out.html out-height.png out-normal.png; do
			[ -f $made ] || continue
			[ ! -f kept.$made ] || cmp $made kept.$made || bad "$tool -j $threads: another $made"
			mv $made kept.$made
		done
	done
	rm -f kept.*

	case $(kind "$tool") in
	filter | source)
		input=all.mrs
		[ "$(kind "$tool")" = filter ] || input=/dev/null
		"$tool" "$@" <$input >/dev/full 2>err
		code=$?
		[ $code -eq 1 ] && one_sentence err "$tool" || bad "$tool >/dev/full: exit $code: $(cat err)"
		"$tool" "$@" -o to.mrs <$input && cmp first to.mrs || bad "$tool -o FILE: other bytes"
		"$tool" "$@" -o no/such/directory/x <$input >out 2>err
		[ $? -eq 1 ] && one_sentence err "$tool" || bad "$tool -o to nowhere: $(cat err)"
		"$tool" "$@" --stats stats.json <$input >out && python3 -c '
import json, sys
assert [json.loads(line)["tool"] for line in open("stats.json")][0] == sys.argv[1]' "$tool" || bad "$tool --stats: no JSON"
		cmp first out || bad "$tool --stats: other bytes"
		"$tool" "$@" <$input | head -c 10 >/dev/null
		if command -v script >/dev/null; then
			script -qec "$tool $* <$input" /dev/null </dev/null >said 2>&1
			code=$?
			[ $code -ne 0 ] && [ "$(wc -c <said)" -lt 300 ] || bad "$tool: binary to a terminal: exit $code"
		fi
		;;
	esac
done

# Wrong names of files are said with the name.
for tool in mr-cat mr-smooth mr-import; do
	try "$tool" no-such-file
	[ $code -eq 1 ] && grep -q no-such-file err && [ ! -s out ] || bad "$tool no-such-file: exit $code: $(cat err)"
done

# A stage that dies takes the pipe with it.
mr-make bumpy -n 500 | mr-select --free all | { mr-solve; echo $? >died; } 2>err | mr-cat >out 2>err2 &&
    bad "a stage died and the pipe did not"
[ "$(cat died)" -eq 1 ] || bad "no vertex fixed, and mr-solve did not mind"
mr-cat <out >/dev/null 2>&1 && bad "a stage died and a whole stream comes out"
exit $fail
