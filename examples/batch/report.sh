#!/bin/sh
# report.sh -- what a batch has come to; usage: report.sh IN OUT PAGE SUFFIXES
# Says which files of IN have another suffix, but those of materials.  Writes in OUT: failed.txt, the files of IN
# without a result, and why; figures.tsv, a row for each result with its verdict and all figures that the tools gave;
# figures.json, the same, a line each, and of what failed; index.html, their pictures, each of which leads to a page
# of PAGE models.
in=$(cd "$1" && pwd) && mkdir -p "$2" && cd "$2" || exit
page=$3 suffixes=$4
work=$(mktemp -d) || exit
trap 'rm -rf "$work"' EXIT
touch "$work/done" "$work/failed.txt"

why() { # folder
	[ -e "$in/$1" ] || { echo "a link to what is not there"; return; }
	[ ! -d "$in/$1" ] || { echo "a folder"; return; }
	[ -d "./$1" ] || {
		echo "not begun; no hidden names can be, nor any with blanks, or signs of make and shells"
		return
	}
	cat "./$1"/*.log 2>/dev/null | tail -n 1 | grep . || echo "ended without a word"
}

# The worst of its frames.
verdict() { # folder
	LC_ALL=C sort -r "./$1/verdict.txt" 2>/dev/null | head -n 1
}

(cd "$in" && find . -mindepth 1 -maxdepth 1) | sed 's,^\./,,' | LC_ALL=C sort >"$work/all"
for suffix in $suffixes; do
	echo "\.$suffix\$"
done >"$work/suffixes"
grep -f "$work/suffixes" "$work/all" | while read -r name; do
	if [ -e "$name/picture.png" ]; then
		printf '%s\t%s\n' "$name" "$(verdict "$name")" >>"$work/done"
	else
		printf '%s\t%s\n' "$name" "$(why "$name")" >>"$work/failed.txt"
	fi
done

many() { # verdict
	grep -c "	$1" "$work/done"
}
made="$(wc -l <"$work/done") made, $(many good) good, $(many poor) poor, $(many unusable) unusable"
made="$made; $(wc -l <"$work/failed.txt") failed"

# A line for each tool of each model, and of these, read twice, a row for each model: columns TOOL.FIGURE, then their
# numbers.  The verdict stands for the findings.
find . -mindepth 2 -maxdepth 2 -name 'mr-*.json' | LC_ALL=C sort |
    xargs -r -d '\n' awk '{ print FILENAME "\t" $0 }' >"$work/all.json"
sed 's,^\./\([^/]*\)[^	]*	{,\1\t,; s/}$//; s/"name":"\([^"\\]\|\\.\)*",//; s/,"findings":{[^}]*}//
	s/"//g' "$work/all.json" \
	>"$work/figures"
awk -F '\t' '
	pass == 0 { verdict[$1] = $2; next }
	!($1 in verdict) { next }
	pass == 2 && $1 != last { flush() }
	{
		n = split($2, field, ",")
		split(field[1], tool, ":")
		for (i = 3; i <= n; i++) {
			split(field[i], pair, ":")
			key = tool[2] "." pair[1]
			if (!(key in seen)) { seen[key] = 1; columns[++count] = key }
			values[key] = pair[2]
		}
		last = $1
	}
	END { if (pass == 2) flush() }
	function flush(    i, row) {
		row = last == "" ? "model\tverdict" : last "\t" verdict[last]
		for (i = 1; i <= count; i++) row = row "\t" (last == "" ? columns[i] : values[columns[i]])
		print row
		split("", values)
	}' pass=0 "$work/done" pass=1 "$work/figures" last= pass=2 "$work/figures" >"$work/figures.tsv"
awk -F '\t' '
	function quoted(s) { gsub(/[\\"]/, "\\\\&", s); gsub(/[\001-\037]/, "?", s); return "\"" s "\"" }
	function end() { if (last != "") print "]}" }
	pass == 0 { verdict[$1] = $2; next }
	pass == 2 { end(); last = ""; print "{\"model\":" quoted($1) ",\"verdict\":" quoted("failed: " $2) "}"; next }
	{ split($1, path, "/"); name = path[2] }
	!(name in verdict) { next }
	name != last { end(); printf "{\"model\":%s,\"verdict\":%s,\"tools\":[", quoted(name), quoted(verdict[name]) }
	{ printf "%s%s", name == last ? "," : "", $2; last = name }
	END { end() }' pass=0 "$work/done" pass=1 "$work/all.json" pass=2 "$work/failed.txt" >"$work/figures.json"

rm -f page-*.html
split -d -a 4 -l "$page" "$work/done" "$work/page-"
{
	echo '<!DOCTYPE html><meta charset="utf-8"><title>Batch</title>'
	echo '<style>figure { display: inline-block; margin: 4px; width: 240px; font: 12px sans-serif;'
	echo 'overflow-wrap: anywhere }</style>'
	echo "<p>$made</p>"
	for part in "$work"/page-[0-9]*; do
		[ -e "$part" ] || continue
		html=$(basename "$part").html
		cut -f 1 "$part" | sed 's,.*,./&/surface.mrs,' | xargs -d '\n' mr-view -q "$html" >&2
		awk -F '\t' -v html="$html" '{
			print "<figure><a href=\"" html "\"><img loading=\"lazy\" width=\"240\" height=\"200\""
			print "src=\"" $1 "/picture.png\"></a><figcaption>" $1 ": " $2 "</figcaption></figure>"
		}' "$part"
	done
} >"$work/index.html"

mv "$work/failed.txt" "$work/figures.tsv" "$work/figures.json" "$work/index.html" .
echo "$made: $PWD/failed.txt, figures.tsv, figures.json, index.html"
head -n 10 failed.txt
grep -v -f "$work/suffixes" "$work/all" | grep -v -i -E '\.(mtl|bin|png|jpe?g)$' >"$work/left" &&
    echo "$(wc -l <"$work/left") of other suffixes left out: $(head -n 5 "$work/left" | paste -sd ' ' -)"
[ ! -s failed.txt ]
