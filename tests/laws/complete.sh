# Every tool has its page and its command test; every page its tool; every test what it expects; every
# promise its tests.
cd "$TOP" || exit
fail=0
for source in cmd/mr-*.c; do
	tool=$(basename "$source" .c)
	[ -f "man/$tool.1" ] || { echo "$tool: no man/$tool.1"; fail=1; }
	set -- tests/cmd/"$tool"*.sh
	[ -f "$1" ] || { echo "$tool: no tests/cmd/$tool*.sh"; fail=1; }
done
for page in man/mr-*.1; do
	tool=$(basename "$page" .1)
	[ -f "cmd/$tool.c" ] || { echo "$page: no cmd/$tool.c"; fail=1; }
	for section in NAME SYNOPSIS DESCRIPTION OPTIONS LAYERS MEMORY 'EXIT STATUS' EXAMPLES 'SEE ALSO'; do
		grep -qx "\.Sh $section" "$page" || { echo "$page: no section $section"; fail=1; }
	done
done
for page in mr.7 mr-promises.7 mr-scale.7 mr-recipes.7 mr-stream.5 mr-formats.5; do
	[ -f "man/$page" ] || { echo "no man/$page"; fail=1; }
done
for test in $(grep -oE '\b(unit|cmd|pipe|bad|laws)/[a-z_-]+' man/mr-promises.7); do
	[ -f "tests/$test.sh" ] || [ -f "tests/$test.c" ] || { echo "mr-promises.7: there is no test $test"; fail=1; }
done
for script in tests/cmd/*.sh; do
	[ -f "${script%.sh}.out" ] || { echo "$script: no .out"; fail=1; }
done
for golden in tests/cmd/*.out tests/cmd/*.err tests/cmd/*.exit; do
	[ -f "$golden" ] || continue
	[ -f "${golden%.*}.sh" ] || { echo "$golden: no script"; fail=1; }
done
exit $fail
