# The page that make demo writes, here of small models: each is drawn, edits have handles, and the line below does in
# the pipe what it does here.
. "$TOP/tests/page/begin"
export MR_SMALL=2000
sh -e "$TOP/examples/demo.sh" >said 2>&1 && sh -e "$TOP/examples/reconstruct.sh" >>said 2>&1 || { cat said; exit 1; }
mr-view -q --beside --pack 0.01% demo/index.html demo/edits/*.mrs demo/scans/*.mrs || exit
exec python3 "$TOP/tests/page/demo.py"
