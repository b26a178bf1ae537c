# Packed surfaces in a page: its bytes are those of mr-pack, its surface that of mr-unpack with the stream's numbers,
# closed, open, creased, coloured and posed; coarse first, and of a scan in 150 kB.
. "$TOP/tests/page/begin"
share=0.02%
mr-make cube -n 20 | mr-view none.html || exit
surface() { # name, of a mesh on stdin
	mr-simplify -q --to control -n 120 | mr-fit -q | mr-sample -q -n 3 |
		mr-select -q -l control --free above:y,0.5 -o "$1.mrs" &&
		mr-pack -q -e $share "$1.mrs" "$1.mrz" && mr-unpack "$1.mrz" -o "$1.un.mrs" &&
		mr-decode -q "$1.mrs" -o "$1.dec.mrs" &&
		mr-view -q --pack $share -l displacement -i "$1.mrs" "$1.html"
}
mr-make knot -n 3000 | surface closed || exit
mr-make plane -n 900 | surface open || exit
mr-make cube -n 3000 | surface creased || exit
python3 "$TOP/tests/page/heights.py" closed.dec.mrs 0 0.1 1 >far.mrs &&
	mr-transform --translate 5e5,4e6,-3e5 far.mrs -o colored.mrs && mr-pack -q -e $share colored.mrs colored.mrz &&
	mr-unpack colored.mrz -o colored.un.mrs && mr-decode -q --no-check colored.mrs -o colored.dec.mrs &&
	mr-view -q --pack $share -i colored.mrs colored.html || exit
mr-select -q -l control --free all --fixed below:y,0.2 --handle 1=above:y,0.8 closed.mrs |
	mr-solve -q -l control --basis | mr-pose -q -H 1 --rotate 0,0,1,40 --frames 2 |
	mr-decode -q --no-check -o film.mrs &&
	mr-view -q --pack $share -l displacement -i film.mrs film.html || exit
mr-make bumpy -n 35000 --points 35000 | mr-shrinkwrap -q | mr-simplify -q | mr-fit -q | mr-sample -q -o scan.mrs &&
	mr-view -q --pack 0.01% -l displacement -i scan.mrs scan.html || exit
exec python3 "$TOP/tests/page/packed.py"
