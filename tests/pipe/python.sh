# The Python package: the bytes of the pipe, whatever way frames take, and a sentence for each fault.  In a wheel's own
# environment, $PYTHON, by make check-wheel; here the package with the tools of this build.
for python in $PYTHON python3 /usr/bin/python3; do
	$python -c 'import numpy' 2>/dev/null && break
	python=
done
[ -n "$python" ] || { echo 'no Python with numpy'; exit 77; }
if [ -z "$PYTHON" ]; then
	cp -R "$TOP/lib/python/mr" . && mr --json | $python "$TOP/lib/python/describe.py" "$TOP/man" >mr/_tools.py || exit
	PYTHONPATH=$PWD
fi
export PYTHONPATH
fail=0
bad() {
	echo "$*"
	fail=1
}

mr-make bumpy -n 2000 | mr-export model.obj
mr-make bumpy --points 3000 | mr-export scan.ply
mr-import model.obj >model.mrs
$python "$TOP/tests/pipe/python.py" || fail=1

# The same as edit.py in a pipe; arguments are spelled as Python does, since they stand in the history.
for example in edit film scan; do
	$python -W error "$TOP/examples/python/$example.py" $([ $example = scan ] && echo scan.ply || echo model.obj) \
		$example.mrs >said || bad "$example.py fails"
done
mr-import model.obj | mr-smooth | mr-remesh | mr-select --free=all --fixed=below:y,0.5 --handle=1=above:y,0.85 |
	mr-solve --basis | mr-encode | mr-pose --handle=1 --rotate=0,0,1,30 | mr-decode | cmp - edit.mrs ||
    bad 'edit.py gives other bytes than the pipe'
mr-import --points scan.ply | mr-shrinkwrap | mr-simplify | mr-fit | mr-sample | cmp - scan.mrs ||
	bad 'scan.py gives other bytes than the pipe'
[ "$(wc -l <said)" -eq "$(ls level-?.ply | wc -l)" ] || bad "levels: $(cat said)"
mr-info --no-intersections film.mrs | grep -c ': frame ' | grep -qx 25 || bad 'film.py has not 25 frames'

# Every tool is there, with each of its options, and the text of its page.
$python - <<'END' || fail=1
import inspect, json, subprocess, sys
import mr
for tool in json.loads(subprocess.run(["mr", "--json"], stdout=subprocess.PIPE, check=True).stdout):
    name = tool["name"][3:] + "_" * (tool["name"] == "mr-import")
    function = getattr(mr, name)
    there = {key.rstrip("_").replace("_", "-") for key in inspect.signature(function).parameters}
    lacks = {o["name"] for o in tool["options"] + tool["common"]} - there
    assert lacks <= {"help", "describe", "version", "output", "input", "json"}, (name, lacks)
    assert tool["name"] + " " in function.__doc__ and "\\" not in function.__doc__ and " Ar " not in function.__doc__, name
END
exit $fail
