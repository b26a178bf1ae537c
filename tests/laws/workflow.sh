# The workflow of .github runs the two commands of README.md, each on a fresh Debian, and is YAML.
fail=0
file=$TOP/.github/workflows/check.yml
sed -n 's/^ *- command: //p' "$file" | sort >runs
awk '/^## Two commands/ { on = 1 } on && /^```/ { if (code) exit; code = 1; next } code { sub(/ *#.*/, ""); print }' \
	"$TOP/README.md" | sort >reads
[ -s reads ] || { echo "README.md has no two commands"; fail=1; }
diff reads runs || { echo "the workflow does not run what README.md says"; fail=1; }
grep -q '^    container: debian:' "$file" || { echo "the workflow does not begin with a fresh Debian"; fail=1; }
if python3 -c 'import yaml' 2>/dev/null; then
	python3 -c 'import sys, yaml; y = yaml.safe_load(open(sys.argv[1]))
sys.exit(not all("run" in s or "uses" in s for j in y["jobs"].values() for s in j["steps"]))' "$file" ||
	    { echo "the workflow is no YAML, or has a step that does nothing"; fail=1; }
fi
exit $fail
