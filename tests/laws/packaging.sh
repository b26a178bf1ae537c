# Recipes for packages of other systems are what they claim to be: Ruby, YAML, steps that a container knows; make
# dist-bin knows all words that it is to fill in.
cd "$TOP/.ci/packaging" || exit
fail=0
bad() {
	echo "$*"
	fail=1
}
for file in *; do
	for word in $(grep -o '@[A-Z0-9]*@' "$file" | sort -u); do
		grep -q "s,$word," "$TOP/.ci/packages.mk" || bad "$file: nobody fills in $word"
	done
	grep -q '@BINARY@' "$file" || bad "$file does not name the tarball"
done
if command -v ruby >/dev/null; then
	ruby -c mr-tools.rb >/dev/null || bad 'the formula is no Ruby'
fi
for python in python3 /usr/bin/python3; do
	$python -c 'import yaml' 2>/dev/null || continue
	$python -c 'import yaml; recipe = yaml.safe_load(open("meta.yaml"))
assert recipe["source"]["sha256"] == "@SHA256@" and recipe["build"]["script"] and recipe["test"]["commands"]' ||
	    bad 'the recipe is no YAML'
done
grep -vE '^(#|$|(FROM|ADD|ENV|WORKDIR|CMD) [^ ])' Containerfile && bad 'a step that no container knows'
exit $fail
