#!/bin/sh
# report.sh -- what a batch has come to; usage: report.sh IN OUT PAGE SUFFIXES
# Says which files of IN have another suffix, but those of materials.  Writes in OUT: failed.txt, the files of IN without a result, and why; warned.txt, what the tools warned of beside
# each result; figures.tsv, a row for each result of all figures that they gave; index.html, their pictures, each of which leads to a page of PAGE models to turn.
in=$(cd "$1" && pwd) && mkdir -p "$2" && cd "$2" || exit
page=$3 suffixes=$4
work=$(mktemp -d) || exit
trap 'rm -rf "$work"' EXIT
touch "$work/done" "$work/failed.txt"

# The last thing said that is no warning.
why() { # folder
	[ -e "$in/$1" ] || { echo "a link to what is not there"; return; }
	[ ! -d "$in/$1" ] || { echo "a folder"; return; }
	[ -d "./$1" ] || { echo "not begun; no hidden names can be, nor any with blanks, or with signs of make and shells"; return; }
	cat "./$1"/*.log 2>/dev/null | grep -v ': warning: ' | tail -n 1 | grep . || echo "ended without a word"
}

(cd "$in" && find . -mindepth 1 -maxdepth 1) | sed 's,^\./,,' | LC_ALL=C sort >"$work/all"
for suffix in $suffixes; do
	echo "\.$suffix\$"
done >"$work/suffixes"
grep -f "$work/suffixes" "$work/all" | while read -r name; do
	if [ -e "$name/picture.png" ]; then
		echo "$name" >>"$work/done"
	else
		printf '%s\t%s\n' "$name" "$(why "$name")" >>"$work/failed.txt"
	fi
done

# The folders of OUT have names without the signs of shells.
find . -mindepth 2 -maxdepth 2 -name '*.log' | LC_ALL=C sort | xargs -r -d '\n' grep -H ': warning: ' |
    awk -F/ 'pass == 0 { done[$0] = 1; next } $2 in done { name = $2; sub(/^[^:]*:/, ""); print name "\t" $0 }' pass=0 "$work/done" pass=1 - >"$work/warned.txt"
made="$(wc -l <"$work/done") made, $(cut -f 1 "$work/warned.txt" | uniq | wc -l) of them with warnings, $(wc -l <"$work/failed.txt") failed"

# A line for each tool of each model, and of these, read twice, a row for each model: columns TOOL.FIGURE, then their numbers.
find . -mindepth 2 -maxdepth 2 -name 'mr-*.json' | LC_ALL=C sort |
    xargs -r -d '\n' awk '{ gsub(/^\{|\}$|"name":"([^"\\]|\\.)*",/, ""); gsub(/"/, ""); print FILENAME "," $0 }' >"$work/figures"
awk -F, '
	pass == 0 { done[$0] = 1; next }
	{ split($1, path, "/"); name = path[2] }
	!(name in done) { next }
	pass == 2 && name != last { flush() }
	{
		split($2, tool, ":")
		for (i = 4; i <= NF; i++) {
			split($i, pair, ":")
			key = tool[2] "." pair[1]
			if (!(key in seen)) { seen[key] = 1; columns[++n] = key }
			values[key] = pair[2]
		}
		last = name
	}
	END { if (pass == 2) flush() }
	function flush(    i, row) {
		row = last == "" ? "model" : last
		for (i = 1; i <= n; i++) row = row "\t" (last == "" ? columns[i] : values[columns[i]])
		print row
		split("", values)
	}' pass=0 "$work/done" pass=1 "$work/figures" last= pass=2 "$work/figures" >"$work/figures.tsv"

rm -f page-*.html
split -d -a 4 -l "$page" "$work/done" "$work/page-"
{
	echo '<!DOCTYPE html><meta charset="utf-8"><title>Batch</title>'
	echo '<style>figure { display: inline-block; margin: 4px; width: 240px; font: 12px sans-serif; overflow-wrap: anywhere }</style>'
	echo "<p>$made</p>"
	for part in "$work"/page-[0-9]*; do
		[ -e "$part" ] || continue
		html=$(basename "$part").html
		sed 's,.*,./&/surface.mrs,' "$part" | xargs -d '\n' mr-view -q "$html" >&2
		awk -F '\t' -v html="$html" 'pass == 0 { warnings[$1]++; next }
			{
				told = $0 in warnings ? ": " warnings[$0] " warning" (warnings[$0] > 1 ? "s" : "") : ""
				print "<figure><a href=\"" html "\"><img loading=\"lazy\" width=\"240\" height=\"200\" src=\"" $0 "/picture.png\"></a><figcaption>" $0 told "</figcaption></figure>"
			}' pass=0 "$work/warned.txt" pass=1 "$part"
	done
} >"$work/index.html"

mv "$work/failed.txt" "$work/warned.txt" "$work/figures.tsv" "$work/index.html" .
echo "$made: $PWD/failed.txt, warned.txt, figures.tsv, index.html"
head -n 10 failed.txt
grep -v -f "$work/suffixes" "$work/all" | grep -v -i -E '\.(mtl|bin|png|jpe?g)$' >"$work/left" &&
    echo "$(wc -l <"$work/left") of other suffixes left out: $(head -n 5 "$work/left" | paste -sd ' ' -)"
[ ! -s failed.txt ]
