# make html: each page of man/ is there, each link and picture is, each recipe has its result, and pictures are small.
command -v mandoc >/dev/null || { echo "no mandoc"; exit 77; }
"$TOP/.ci/html" html && cd html || exit
fail=0
for page in "$TOP"/man/*.[1-9]; do
	grep -q '</main>' "${page##*/}.html" || { echo "${page##*/} is not there"; fail=1; }
	grep -q "\"${page##*/}.html\"" index.html || { echo "index.html has no link to ${page##*/}"; fail=1; }
done
for page in *.html; do
	grep -oE '(href|src)="[^"]*"' "$page" | sed 's/[^"]*"//; s/"$//' | sort -u >links
	while read -r link; do
		file=${link%%#*} place=${link#"$file"}
		[ -e "${file:-$page}" ] || { echo "$page: no $link"; fail=1; }
		[ -z "$place" ] || grep -qF "id=\"${place#\#}\"" "${file:-$page}" ||
			{ echo "$page: no place $link"; fail=1; }
	done <links
done
[ "$(grep -cE '<img |class="out"' mr-recipes.7.html)" -ge 30 ] || { echo "recipes without results"; fail=1; }
find . -name 'recipe-*.png' -size +60k | grep . && { echo "pictures are too large"; fail=1; }
exit $fail
