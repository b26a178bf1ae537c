# The front end: it lists every tool, runs one with its exit code, describes all in JSON, and names the near miss.
mr | awk '/^  [a-z]/ { print "mr-" $1 }' | sort >listed
(cd "$BUILD/bin" && ls -d mr-* | grep -v '\.') | sort >there
cmp listed there && echo 'all tools are listed'
mr make cube -n 12 | mr mr-info | sed -n 3p
mr make nothing 2>/dev/null
echo "exit $?"
for word in smoth smooth-er xyzzy ''; do
	mr "$word"
	echo "exit $?"
done
mr help nonsense
echo "exit $?"
PATH=$BUILD/bin mr help cat | sed -n 1p
"$BUILD/bin/mr" --version
mr --json >tools.json
python3 - <<'PY'
import json
tools = {t["name"]: t for t in json.load(open("tools.json"))}
print(len(tools) == len(open("there").readlines()), all(t["summary"] and t["operands"] and t["common"] for t in tools.values()))
options = {o["name"]: o for o in tools["mr-smooth"]["options"]}
for name in "time", "method":
    print(json.dumps(options.get(name)))
print(json.dumps(next(o for o in tools["mr-solve"]["common"] if o["name"] == "threads")))
PY
mr-smooth --describe | python3 -c 'import json, sys; print(json.load(sys.stdin)["name"])'
