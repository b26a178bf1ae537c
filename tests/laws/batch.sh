# examples/batch: all results or sentences, whatever the files are called; what is killed in the middle is made up for,
# with the bytes of a run in peace; GNU parallel makes the same.
[ -z "$SAN" ] || { echo "make has no use for sanitizers here"; exit 77; }
batch=$TOP/examples/batch
fail=0
complain() { echo "$*"; fail=1; }
batch() { # folder, arguments of make
	out=$1
	shift
	make -s -f "$batch/Makefile" IN="$PWD/models" OUT="$PWD/$out" "$@"
}
same() { # folder: but for times, which are in the .json and figures.tsv
	diff -r -q -x '*.json' -x figures.tsv peace "$1" >differences ||
		{ cat differences; complain "$1 is not what a run in peace makes"; }
}

mkdir models
for seed in 1 2 3 4; do
	mr-make torus -n 200 --noise 1% --seed $seed | mr-export models/torus-$seed.ply
	mr-make sphere --points 200 --seed $seed | mr-export models/ball.$seed.xyz
done
# A face the other way round, which the batch repairs.
mr-import models/torus-4.ply | mr-export -f off - |
	awk 'NF == 4 && !n++ { $0 = "3 " $2 " " $4 " " $3 } 1' >models/torus-4.off
rm models/torus-4.ply
mr-make cube -n 200 | mr-transform --translate 0.3,0.2,0.9 -o cube.mrs
mr-make sphere -n 300 | mr-cat --append cube.mrs - | mr-export models/-crossing.obj # two bodies in one another
mr-make torus -n 200 | mr-export models/ring.off.gz
ln -s nothing models/nowhere.ply
mr-make sphere --points 200 | mr-export models/cloud.pts && mv models/cloud.pts models/CLOUD.PTS
head -c 1000 models/torus-1.ply >models/broken.ply
echo 'no model' >models/README

# Names that would be commands, other targets or nothing to make.
for name in 'two words' 'a;touch gone;' 'a:b=c' 'b%' "it's" '$(shell touch gone)' 'x&y' '<b>' 'a,b'; do
	cp models/torus-1.ply "models/$name.ply"
done
cp models/torus-1.ply models/.hidden.ply
mkdir models/folder.ply

batch peace >peace.log 2>&1 && complain "make succeeds with a broken model"
[ ! -e gone ] || complain "the name of a file is run"
[ "$(cat peace/*/picture.png | grep -ac IHDR)" -eq 11 ] || { cat peace.log; complain "not eleven pictures"; }
grep -q "^1 of other suffixes left out: README$" peace.log || complain "what is no model is not told of"
[ "$(ls peace/*/surface.ply | wc -l)" -eq 11 ] || complain "not eleven surfaces"
[ "$(wc -l <peace/figures.tsv)" -eq 12 ] || complain "not eleven rows of figures"
awk -F '\t' 'NR == 1 { n = NF; if ($2 != "verdict" || $3 !~ /^mr-[a-z]*\./) exit 1 }
	NF != n || (NR > 1 && ($2 !~ /^(good|poor: [a-z]+|unusable: [a-z]+)$/ || $3 !~ /^[0-9.e-]+$/)) { exit 1 }' \
	peace/figures.tsv ||
    { cut -c1-200 peace/figures.tsv; complain "the figures are no table"; }
[ "$(wc -l <peace/failed.txt)" -eq 13 ] || { cat peace/failed.txt; complain "not thirteen failures"; }
grep -q "^folder.ply	a folder$" peace/failed.txt || complain "a folder is not told of"
grep -q "^nowhere.ply	a link to what is not there$" peace/failed.txt || complain "a link to nothing is not told of"
for verdict in good poor unusable; do
	cat peace/*/verdict.txt | grep -c "^$verdict"
done >counts
grep -q '^poor: crossing' peace/-crossing.obj/verdict.txt || complain "what crosses itself is not poor"
grep -q "^11 made, $(sed -n 1p counts) good, $(sed -n 2p counts) poor, $(sed -n 3p counts) unusable; 13 failed: " \
	peace.log ||
    { cat peace.log; complain "the verdicts are not counted"; }
python3 -c '
import json
rows = [json.loads(line) for line in open("peace/figures.json")]
bad = len(rows) != 24 or sum(row["verdict"].startswith("failed: ") for row in rows) != 13
bad |= any("tools" not in row for row in rows[:11])
raise SystemExit(bad)' || complain "figures.json has not 11 results and 13 failures"
[ "$(cat peace/*/*.log | grep -vc ': warning: ')" -eq 1 ] ||
    { cat peace/*/*.log; complain "the tools say more than what failed"; }
grep -q "^broken.ply	mr-import: .*models/broken.ply: byte" peace/failed.txt ||
	complain "a broken model without its sentence"
grep -q "^two words.ply	not begun; no hidden names can be, nor any with blanks" peace/failed.txt ||
	complain "a name with blanks is not told of"
[ "$(grep -o '<img' peace/index.html | wc -l)" -eq 11 ] && [ -s peace/page-0000.html ] ||
	complain "the gallery is not of eleven models"

# Killed at some time, with all that it started; a model whose file is newer is made again, and only that.
for pause in 0.1 0.3 0.6; do
	timeout -s KILL $pause make -s -k -j2 -f "$batch/Makefile" IN="$PWD/models" OUT="$PWD/killed" models \
		>/dev/null 2>&1
done
batch killed >killed.log 2>&1
same killed
touch models/torus-2.ply
batch killed -n -k models 2>/dev/null | grep -o "$PWD/models/[^ ]*" | grep -v broken >again
[ "$(cat again)" = "$PWD/models/torus-2.ply" ] || { cat again; complain "not only the newer file is made again"; }
batch killed models -k 2>/dev/null
same killed

# A broken file in place of a good one leaves nothing of what was made of that.
cp models/broken.ply models/torus-3.ply
batch killed >killed.log 2>&1
[ ! -e killed/torus-3.ply/picture.png ] && grep -q '^torus-3.ply	mr-import' killed/failed.txt ||
	complain "an old result stands for a broken file"
mr-make torus -n 200 --noise 1% --seed 3 | mr-export models/torus-3.ply

# What is read is not written over.
cp -r models models.before
make -s -k -f "$batch/Makefile" IN="$PWD/models" OUT="$PWD/models" models >/dev/null 2>&1 &&
	complain "results go where the models are"
diff -r --no-dereference models models.before || complain "models are written over"

if parallel --version 2>/dev/null | grep -q GNU; then
	batch parallel names |
		parallel -j 2 -n 4 make -s -k -f "$batch/Makefile" IN="$PWD/models" OUT="$PWD/parallel" >parallel.log \
			2>&1
	batch parallel report >>parallel.log
	same parallel
fi
exit $fail
